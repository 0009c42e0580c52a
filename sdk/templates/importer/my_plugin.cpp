// An importer: a line `x y` is a point, an empty line ends a polygon. Everything is made in the request's transaction,
// so an import is one undo step, and one that fails leaves nothing.
#include <jet/format.hpp>
#include <jet/plugin.hpp>

#include <string_view>
#include <utility>
#include <vector>

namespace {

class Reader {
public:
    explicit Reader(jet::ImportRequest& request) : request_(request) {}

    jet::Result<void> read()
    {
        std::string_view rest(reinterpret_cast<const char*>(request_.data.data()), request_.data.size());
        const double size = static_cast<double>(rest.size());
        while (!rest.empty()) {
            ++line_;
            const std::string_view line = rest.substr(0, rest.find('\n'));
            rest.remove_prefix(std::min(rest.size(), line.size() + 1));
            if (auto result = readLine(line); !result) return result;
            if (line_ % 1000 == 0 && !request_.progress(1 - static_cast<double>(rest.size()) / size))
                return jet::Error("The import was cancelled.", here());
        }
        endPolygon();
        return {};
    }

private:
    jet::Location here() const { return {request_.file.string(), line_, 0}; }

    jet::Result<void> readLine(std::string_view line)
    {
        skipSpace(line);
        if (line.empty()) return endPolygon(), jet::Result<void>();
        jet::Vec2 point;
        for (double* coordinate : {&point.x(), &point.y()}) {
            skipSpace(line);
            if (!jet::readNumber(line, *coordinate))
                return jet::Error("A point is two numbers, but here is '" + std::string(line.substr(0, 20)) + "'.",
                                  here());
        }
        skipSpace(line);
        if (!line.empty()) return jet::Error("A point is two numbers, but more follows on this line.", here());
        points_.push_back(point);
        return {};
    }

    static void skipSpace(std::string_view& text)
    {
        while (!text.empty() && (text.front() == ' ' || text.front() == '\t' || text.front() == '\r'))
            text.remove_prefix(1);
    }

    void endPolygon()
    {
        const std::vector<jet::Vec2> points = std::exchange(points_, {});
        if (points.size() == 1) request_.notes.push_back({"A single point makes no polygon; it was left out.", here()});
        if (points.size() > 1) request_.edit.add<jet::ShapeItem>(request_.parent, jet::Path::polygon(points));
    }

    jet::ImportRequest& request_;
    std::vector<jet::Vec2> points_;
    int line_ = 0;
};

class MyPluginImporter final : public jet::Importer {
public:
    jet::Result<void> read(jet::ImportRequest& request) override { return Reader(request).read(); }
};

}  // namespace

JET_PLUGIN(plugin) { plugin.importer<MyPluginImporter>("my-plugin"); }
