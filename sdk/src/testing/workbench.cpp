#include <jet/testing/workbench.hpp>

#include <jet/project.hpp>
#include <jet/scene_painter.hpp>

#include <algorithm>

namespace jet::test {

namespace {

/// Everything: what is painted must not depend on where it lies.
Box wholePlane() { return Box({-1e9, -1e9}, {1e9, 1e9}); }

}  // namespace

std::string Exported::text() const
{
    if (!result) throw Failure(result.error());
    return std::string(reinterpret_cast<const char*>(result->data()), result->size());
}

Workbench::Workbench(std::initializer_list<std::string_view> plugins)
    : catalog_(plugins), scene_("Scene", events_, catalog_), host_(scene_), emptyHash_(scene_.hash())
{
}

Workbench::~Workbench() = default;

TestEditor& Workbench::editor()
{
    if (!editor_) {
        editor_ = std::make_unique<TestEditor>(events_, catalog_);
        editor_->openScene(scene_);
    }
    return *editor_;
}

ToolDriver& Workbench::tool(std::string_view id)
{
    auto found = tools_.find(id);
    if (found == tools_.end()) {
        auto made = catalog_.createTool(id, host_);
        if (!made) throw Failure(Error(catalog_.explain(ContributionKind::Tool, id)));
        found = tools_.emplace(std::string(id), std::make_unique<ToolDriver>(host_, std::move(made))).first;
    }
    if (active_ != id) {
        if (!active_.empty()) (*tools_.find(active_)->second)->deactivate();
        active_ = id;
        (*found->second)->activate();
    }
    return *found->second;
}

const Item& Workbench::add(std::string_view type, Path path, const Item* parent)
{
    auto edit = items().begin("Add");
    const Item& item = edit.add(type, parent ? *parent : items().root(), std::move(path));
    edit.commit();
    return item;
}

const Item& Workbench::addRectangle(const Box& box, const Item* parent)
{
    return add(ShapeItem::type, Path::rectangle(box), parent);
}

const Item& Workbench::apply(std::string_view effect, const Item& item, Properties properties)
{
    auto edit = items().begin("Apply effect");
    edit.addEffect(item, effect, std::move(properties));
    edit.commit();
    return item;
}

RecordingPainter Workbench::painted(const Item& item, PaintPurpose purpose)
{
    RecordingPainter painter(host_.scale);
    paintItem(scene_, item, item.path(), purpose, painter);
    return painter;
}

RecordingPainter Workbench::painted(PaintPurpose purpose)
{
    RecordingPainter painter(host_.scale);
    paintScene(scene_, nullptr, purpose, wholePlane(), painter);
    return painter;
}

RecordingPainter Workbench::painted(const Simulation& simulation)
{
    RecordingPainter painter(host_.scale);
    paintScene(simulation.scene(), &simulation, PaintPurpose::Play, wholePlane(), painter);
    return painter;
}

Imported Workbench::importFile(const std::filesystem::path& file)
{
    const Result<std::string> content = readFile(file);
    if (!content) return {content.error(), {}, {}};
    return importBytes(*content, file);
}

Imported Workbench::importBytes(std::string_view bytes, const std::filesystem::path& name)
{
    const std::string extension = extensionOf(name);
    Importer* importer = catalog_.importer(extension);
    if (!importer) throw Failure(Error(catalog_.explain(ContributionKind::Importer, extension)));
    Imported imported{{}, {}, {}};
    auto edit = items().begin("Import");
    const Item& parent = host_.insertionPoint(edit);
    const std::size_t before = parent.children().size();
    ImportRequest request{name, std::as_bytes(std::span(bytes)), edit, parent, imported.notes, {}};
    imported.result = importer->read(request);
    if (!imported.result) return imported;  // leaving the transaction rolls it back
    edit.commit();
    std::vector<const Item*> made;
    for (std::size_t i = before; i < parent.children().size(); ++i) made.push_back(parent.children()[i].get());
    imported.items = ItemList(std::move(made));
    return imported;
}

Exported Workbench::exportScene(std::string_view extension, const ExportOptions& options)
{
    Exporter* exporter = catalog_.exporter(extension);
    if (!exporter) throw Failure(Error(catalog_.explain(ContributionKind::Exporter, extension)));
    std::vector<FormatNote> notes;
    const ExportRequest request{scene_,
                                nullptr,
                                options.view,
                                options.width,
                                options.height,
                                options.background,
                                "scene." + std::string(extension),
                                notes,
                                {}};
    auto result = exporter->write(request);
    return {std::move(result), std::move(notes)};
}

bool Workbench::run(std::string_view command)
{
    Command* found = catalog_.command(command);
    if (!found) throw Failure(Error(catalog_.explain(ContributionKind::Command, command)));
    if (!found->isEnabled(editor())) return false;
    found->run(editor());
    return true;
}

std::unique_ptr<Simulation> Workbench::play(int steps, SimulationOptions options)
{
    auto simulation = Simulation::start(scene_, std::move(options)).orThrow();
    for (int i = 0; i < steps; ++i) simulation->step();
    return simulation;
}

std::string Workbench::textAfterReload()
{
    std::vector<FormatNote> notes;
    const auto again = readSceneText(scene_.text(), "scene", events_, catalog_, notes).orThrow();
    return writeSceneText(*again);
}

}  // namespace jet::test
