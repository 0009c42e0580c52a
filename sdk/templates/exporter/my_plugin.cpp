// An exporter: the points of each shown shape, one a line, with an empty line between two shapes.
#include <jet/format.hpp>
#include <jet/plugin.hpp>

#include <span>
#include <string>

namespace {

class MyPluginExporter final : public jet::Exporter {
public:
    jet::Result<std::vector<std::byte>> write(const jet::ExportRequest& request) override
    {
        std::string text;
        request.scene.root().walk([&](const jet::Item& item) {
            if (!item.visible()) return false;  // what is hidden, with all it holds, is not written
            for (const jet::Polyline& line : path(item, request).polygonized()) append(text, line);
            return true;
        });
        const auto bytes = std::as_bytes(std::span(text));
        return std::vector<std::byte>(bytes.begin(), bytes.end());
    }

private:
    /// The present path in a running game, else the one it was drawn with.
    static const jet::Path& path(const jet::Item& item, const jet::ExportRequest& request)
    {
        const jet::Path* pose = request.poses ? request.poses->pose(item) : nullptr;
        return pose ? *pose : item.path();
    }

    static void append(std::string& text, const jet::Polyline& line)
    {
        if (!text.empty()) text += '\n';
        for (const jet::Vec2& p : line.points) {
            jet::appendNumber(text, p.x());
            text += ' ';
            jet::appendNumber(text, p.y());
            text += '\n';
        }
    }
};

}  // namespace

JET_PLUGIN(plugin) { plugin.exporter<MyPluginExporter>("my-plugin"); }
