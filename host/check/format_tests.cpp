// Importers against hostile files, exporters on odd scenes.
#include "hostile.hpp"
#include "tests.hpp"

#include "host/plugins/plugin_manager.hpp"

#include <jet/format.hpp>
#include <jet/project.hpp>

#include <algorithm>

namespace jet::host::check {

namespace fs = std::filesystem;

namespace {

const Contribution& contributionOf(const Context& context, ContributionKind kind)
{
    for (const Contribution& one : context.manifest.contributions)
        if (one.kind == kind && one.id == context.contribution) return one;
    context.fail("its manifest declares no such contribution");
}

struct Sample {
    std::string name, bytes;
};

/// Files of the extension in the folder given, and in the plugin's own folder "samples".
std::vector<Sample> samplesFor(const Context& context, const std::string& extension)
{
    std::vector<Sample> samples;
    for (const fs::path& folder : {context.samples, context.folder / "samples"}) {
        std::error_code ignored;
        std::vector<fs::path> files;
        if (folder.empty()) continue;
        for (const auto& entry : fs::directory_iterator(folder, ignored))
            if (extensionOf(entry.path()) == extension) files.push_back(entry.path());
        std::sort(files.begin(), files.end());
        for (const fs::path& file : files)
            if (auto text = readFile(file)) samples.push_back({file.filename().string(), std::move(*text)});
    }
    return samples;
}

/// What an exporter of the same extension makes of a scene, of this plugin or another one.
std::optional<Sample> exported(Stage& stage, const std::string& extension)
{
    Exporter* exporter = stage.catalog.exporter(extension);
    if (!exporter) {
        PluginOptions options;
        options.searchPath = {stage.context.folder.parent_path(), userPluginFolder(), builtInPluginFolder()};
        PluginManager manager(std::move(options));
        manager.scan();
        for (const Contribution& one : manager.contributions(ContributionKind::Exporter))
            if (std::find(one.extensions.begin(), one.extensions.end(), extension) != one.extensions.end()) try {
                    stage.catalog.loadFolder(manager.plugin(one.plugin)->folder);
                } catch (const Failure&) {
                    return std::nullopt;
                }
        exporter = stage.catalog.exporter(extension);
    }
    if (!exporter) return std::nullopt;
    Stage filled(stage.context);
    filled.fill();
    std::vector<FormatNote> notes;
    const ExportRequest request{filled.scene, nullptr, {}, 64, 64, {}, "sample." + extension, notes, {}};
    const auto bytes = stage.context.call("Exporter::write", [&] { return exporter->write(request); });
    if (!bytes) return std::nullopt;
    return Sample{"sample." + extension, std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size())};
}

/// One file into one scene: read or refused, and nothing in between.
class Importing {
public:
    Importing(Context& context, std::string extension)
        : context_(context), stage_(context), extension_(std::move(extension))
    {
        importer_ = context.call("factory", [&] { return stage_.catalog.importer(extension_); });
        if (!importer_) context.fail("the importer cannot be made");
    }

    bool import(const std::string& bytes, const std::string& what)
    {
        context_.activity("a file ." + extension_ + " " + what);
        const std::uint64_t before = stage_.scene.hash();
        const bool read = readInto(bytes);
        stage_.checkClosed("Importer::read");
        if (!read && stage_.scene.hash() != before)
            context_.fail(context_.where("a failed import leaves something in the scene"));
        if (!read) return false;
        stage_.scene.undoRedo().undo();
        if (stage_.scene.hash() != before)
            context_.fail(context_.where("an import that was undone leaves something in the scene"));
        return true;
    }
    Stage& stage() { return stage_; }
    bool saveChecks = false;  ///< save and paint what was read

private:
    bool readInto(const std::string& bytes)
    {
        std::vector<FormatNote> notes;
        auto edit = stage_.items().begin("Import");
        const Item& parent = edit.add<LayerItem>(stage_.items().root());
        ImportRequest request{"hostile." + extension_, std::as_bytes(std::span(bytes)), edit, parent, notes, {}};
        const auto result = context_.call("Importer::read", [&]() -> Result<void> {
            try {
                return importer_->read(request);
            } catch (const Failure& failure) {
                return failure.error();  // a word about the file
            }
        });
        if (!edit.isOpen())
            context_.fail(context_.where("Importer::read ended the transaction, which is its caller's"));
        if (!result && result.error().message.empty())
            context_.fail(context_.where("Importer::read fails without a message"));
        if (!result) return false;
        edit.commit();
        if (saveChecks) {
            stage_.checkSaving();
            stage_.checkPainting();
        }
        return true;
    }

    Context& context_;
    Stage stage_;
    std::string extension_;
    Importer* importer_ = nullptr;
};

}  // namespace

void testImporter(Context& context)
{
    for (const std::string& extension : contributionOf(context, ContributionKind::Importer).extensions) {
        Importing importing(context, extension);
        for (const HostileFile& file : genericHostileFiles(context.random)) importing.import(file.bytes, file.what);
        auto samples = samplesFor(context, extension);
        if (samples.empty())
            if (auto made = exported(importing.stage(), extension)) samples.push_back(std::move(*made));
        for (const Sample& sample : samples) {
            importing.saveChecks = true;
            if (!importing.import(sample.bytes, "as it should be (" + sample.name + ")"))
                context.fail("the sample " + sample.name + " is not read");
            importing.saveChecks = false;
            for (const HostileFile& file : damaged(sample.bytes, context.random))
                importing.import(file.bytes, file.what + " (" + sample.name + ")");
        }
    }
}

namespace {

struct Size {
    int width, height;
};

void write(Stage& stage, Exporter& exporter, const std::string& what, const Size& size, std::optional<View> view,
           bool mayFail)
{
    Context& context = stage.context;
    context.activity(what + ", " + std::to_string(size.width) + " x " + std::to_string(size.height));
    std::vector<FormatNote> notes;
    const std::uint64_t before = stage.scene.hash();
    const ExportRequest request{
        stage.scene, nullptr, view, size.width, size.height, {}, "scene." + context.contribution, notes, {}};
    const auto bytes = context.call("Exporter::write", [&]() -> Result<std::vector<std::byte>> {
        try {
            return exporter.write(request);
        } catch (const Failure& failure) {
            return failure.error();
        }
    });
    stage.checkClosed("Exporter::write");
    if (stage.scene.hash() != before) context.fail(context.where("Exporter::write changes the scene"));
    if (!bytes && bytes.error().message.empty()) context.fail(context.where("Exporter::write fails without a message"));
    if (!bytes && !mayFail)
        context.fail(context.where("Exporter::write refuses an ordinary scene: " + bytes.error().message));
    if (!bytes) return;
    const auto again = context.call("Exporter::write", [&] { return exporter.write(request); });
    if (!again || *again != *bytes) context.fail(context.where("Exporter::write gives other bytes for the same scene"));
}

}  // namespace

void testExporter(Context& context)
{
    const Contribution& declared = contributionOf(context, ContributionKind::Exporter);
    Stage stage(context);
    Exporter* exporter = context.call("factory", [&] { return stage.catalog.exporter(declared.extensions.front()); });
    if (!exporter) context.fail("the exporter cannot be made");
    write(stage, *exporter, "an empty scene", {0, 0}, {}, true);
    write(stage, *exporter, "an empty scene", {1, 1}, {}, true);
    stage.fill();
    write(stage, *exporter, "an ordinary scene", {200, 100}, {}, false);
    write(stage, *exporter, "an ordinary scene", {0, 0}, {}, true);
    for (const Size size :
         {Size{1, 1}, Size{-1, -1}, Size{1, 0}, Size{1'000'000'000, 1'000'000'000}, Size{1'000'000, 1}})
        write(stage, *exporter, "an odd size", size, {}, true);
    write(stage, *exporter, "a view without scale", {20, 20}, View{{0, 0}, 0}, true);
    write(stage, *exporter, "a view far away", {20, 20}, View{{1e12, -1e12}, 1e-9}, true);
    for (int i = 0; i < 20; ++i) {
        stage.editElsewhere();
        write(stage, *exporter, "random scene " + std::to_string(i), {50, 50}, {}, true);
    }
    auto edit = stage.items().begin("Far");
    edit.add<ShapeItem>(stage.items().root(), Path::rectangle(Box({-1e15, -1e15}, {1e15, 1e15})));
    edit.commit();
    write(stage, *exporter, "a scene as large as the solar system", {50, 50}, {}, true);
}

}  // namespace jet::host::check
