// A scene as text (docs/file-format.md): one element a line, properties in alphabetical order, numbers in their
// shortest exact form, so that equal scenes have equal bytes and a change is a small difference in version control.
#include "symbol_text.hpp"
#include "xml_text.hpp"

#include <jet/project.hpp>

namespace jet {

namespace {

class SceneTextWriter {
public:
    explicit SceneTextWriter(const Scene& scene) : scene_(scene) {}

    std::string write()
    {
        out_ = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<scene version=\"1\">\n";
        writeSettings();
        writeMaterials();
        writeSymbols();
        for (const auto& item : scene_.root().children()) writeItem(*item, 1);
        out_ += "</scene>\n";
        return std::move(out_);
    }

private:
    void indent(int depth) { out_.append(static_cast<std::size_t>(depth) * 2, ' '); }

    void writeProperties(const Properties& properties, int depth, bool linked = false)
    {
        for (const auto& [id, value] : properties.entries()) {
            if (linked && linkTable().find(id)) continue;
            indent(depth);
            out_ += "<property id=\"";
            appendXmlEscaped(out_, id);
            out_ += "\">";
            appendXmlContent(out_, value.text());
            out_ += "</property>\n";
        }
    }

    void writeSettings()
    {
        if (scene_.settings().isEmpty()) return;
        out_ += "  <settings>\n";
        writeProperties(scene_.settings(), 2);
        out_ += "  </settings>\n";
    }

    void writeMaterials()
    {
        const MaterialTable& table = scene_.materials();
        if (table == MaterialTable()) return;
        out_ += "  <materials>\n";
        for (const std::string& name : table.names()) out_ += "    <material" + xmlAttribute("name", name) + "/>\n";
        for (std::size_t a = 0; a < table.size(); ++a)
            for (std::size_t b = a; b < table.size(); ++b) {
                const MaterialPair& pair = table.pair(a, b);
                out_ += "    <pair" + xmlAttribute("a", table.names()[a]) + xmlAttribute("b", table.names()[b]) +
                        xmlAttribute("friction", numberText(pair.friction)) +
                        xmlAttribute("restitution", numberText(pair.restitution)) +
                        xmlAttribute("collides", pair.collides ? "true" : "false") + "/>\n";
            }
        out_ += "  </materials>\n";
    }

    void writeSymbols()
    {
        const auto symbols = symbolsOf(scene_);
        if (symbols.empty()) return;
        out_ += "  <symbols>\n";
        for (const Item* symbol : symbols) {
            out_ += "    <symbol" + xmlAttribute("id", std::to_string(symbol->id().value)) +
                    xmlAttribute("name", symbol->name()) +
                    xmlAttribute("key", symbol->property(kSymbolKey).value_or(Value("")).as<std::string>());
            if (symbol->children().empty()) {
                out_ += "/>\n";
                continue;
            }
            out_ += ">\n";
            for (const auto& member : symbol->children()) writeItem(*member, 3);
            out_ += "    </symbol>\n";
        }
        out_ += "  </symbols>\n";
    }

    void writeItem(const Item& item, int depth)
    {
        indent(depth);
        out_ += "<item type=\"";
        appendXmlEscaped(out_, item.type());
        out_ += "\" id=\"";
        out_ += std::to_string(item.id().value);
        out_ += "\" name=\"";
        appendXmlEscaped(out_, item.name());
        out_ += '"';
        if (!item.visible()) out_ += " visible=\"false\"";
        if (item.locked()) out_ += " locked=\"true\"";
        if (item.path().isEmpty() && item.properties().isEmpty() && item.effects().empty() && item.children().empty()) {
            out_ += "/>\n";
            return;
        }
        out_ += ">\n";
        if (!item.path().isEmpty()) {
            indent(depth + 1);
            out_ += "<path>" + item.path().text() + "</path>\n";
        }
        const bool linked = isInstance(item);
        writeProperties(item.properties(), depth + 1, linked);
        if (linked) indent(depth + 1), appendInstance(out_, item);
        for (const EffectInstance& effect : item.effects()) writeEffect(effect, depth + 1);
        if (!linked)
            for (const auto& child : item.children()) writeItem(*child, depth + 1);
        indent(depth);
        out_ += "</item>\n";
    }

    void writeEffect(const EffectInstance& effect, int depth)
    {
        indent(depth);
        out_ += "<effect type=\"";
        appendXmlEscaped(out_, effect.type);
        out_ += effect.visible ? "\"" : "\" visible=\"false\"";
        if (effect.properties.isEmpty()) {
            out_ += "/>\n";
            return;
        }
        out_ += ">\n";
        writeProperties(effect.properties, depth + 1);
        indent(depth);
        out_ += "</effect>\n";
    }

    const Scene& scene_;
    std::string out_;
};

}  // namespace

std::string writeSceneText(const Scene& scene) { return SceneTextWriter(scene).write(); }

}  // namespace jet
