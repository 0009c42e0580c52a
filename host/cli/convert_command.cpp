// jet convert INPUT... OUTPUT: any importer to any exporter. A batch goes on after a failure and names the reason of
// each.
#include "project_access.hpp"

#include "host/projects/project_archive.hpp"

#include <jet/effect.hpp>
#include <jet/format.hpp>
#include <jet/item_type.hpp>

#include <cstdio>
#include <cstdlib>
#include <map>
#include <unistd.h>

namespace jet::host {

namespace fs = std::filesystem;

namespace {

/// "effect:property=value,property=value" of --apply.
struct EffectRequest {
    std::string effect;
    std::vector<std::pair<std::string, std::string>> values;
};

std::pair<std::string, std::string> assignment(const std::string& text)
{
    const auto equals = text.find('=');
    if (equals == std::string::npos) throw Failure(Error("'" + text + "' is not property=value"));
    return {text.substr(0, equals), text.substr(equals + 1)};
}

EffectRequest effectRequest(const std::string& text)
{
    EffectRequest request;
    const auto colon = text.find(':');
    request.effect = text.substr(0, colon);
    if (colon == std::string::npos) return request;
    std::string rest = text.substr(colon + 1);
    while (!rest.empty()) {
        const auto comma = rest.find(',');
        request.values.push_back(assignment(rest.substr(0, comma)));
        rest = comma == std::string::npos ? "" : rest.substr(comma + 1);
    }
    return request;
}

class Converter {
public:
    Converter(Session& session, const ConvertOptions& options) : session_(session), options_(options)
    {
        for (const std::string& text : options.effects) effects_.push_back(effectRequest(text));
        for (const std::string& text : options.properties) properties_.push_back(assignment(text));
        if (!options.background.empty()) {
            background_ = Color::parse(options.background).orThrow();
        }
    }

    int run()
    {
        const bool pattern = options_.output.filename().string().find('*') != std::string::npos;
        if (pattern || options_.inputs.size() == 1) return runEach(pattern);
        if (!isProject(options_.output))
            throw Failure(Error("several inputs need a project as output, or '*' in its name, e.g. 'out/*.png'"));
        return runIntoOneProject();
    }

private:
    static bool isProject(const fs::path& path)
    {
        return extensionOf(path) == "jet" || extensionOf(path).empty() || isFolder(path) || isPacked(path);
    }
    static bool isPacked(const fs::path& path)
    {
        return extensionOf(path) == kPackedProjectExtension && !isFolder(path);
    }
    static bool isFolder(const fs::path& path)
    {
        std::error_code ignored;
        return fs::is_directory(path, ignored);
    }

    int runEach(bool pattern)
    {
        std::size_t failed = 0;
        std::map<fs::path, fs::path> written;  // output -> input
        for (const fs::path& input : options_.inputs) {
            fs::path output = options_.output;
            if (pattern) {
                std::string name = output.filename().string();
                const std::string stem =
                    input.has_stem() ? input.stem().string() : input.parent_path().filename().string();
                name.replace(name.find('*'), 1, stem);
                output.replace_filename(name);
            }
            try {
                const auto [before, isNew] = written.emplace(output, input);
                if (!isNew)
                    throw Failure(Error("'" + output.string() + "' was made from '" + before->second.string() +
                                        "' already; give the inputs names that differ"));
                convertOne(input, output);
                if (session_.options().verbose) std::printf("%s -> %s\n", input.c_str(), output.c_str());
            } catch (const Failure& failure) {
                ++failed;
                report(input, failure.error());
            } catch (const std::exception& e) {
                ++failed;
                report(input, Error(e.what()));
            }
        }
        if (options_.inputs.size() > 1)
            std::printf("%zu converted, %zu failed\n", options_.inputs.size() - failed, failed);
        return failed == 0 ? kOk : kFailed;
    }

    void report(const fs::path& input, Error error)
    {
        if (error.where.file.empty()) error.where.file = input.string();
        session_.error(error);
    }

    int runIntoOneProject()
    {
        session_.compareWithSet();
        auto project = emptyProject(options_.output.stem().string());
        std::size_t failed = 0;
        for (const fs::path& input : options_.inputs) {
            std::string name = input.stem().string();
            for (int i = 2; project->scene(name); ++i) name = input.stem().string() + " " + std::to_string(i);
            Scene& scene = project->addScene(name);
            try {
                importInto(scene, input);
            } catch (const Failure& failure) {
                ++failed;
                report(input, failure.error());
                project->removeScene(scene);
            }
        }
        if (project->scenes().empty()) return kFailed;
        saveProject(*project, options_.output);
        std::printf("%zu converted, %zu failed\n", options_.inputs.size() - failed, failed);
        return failed == 0 ? kOk : kFailed;
    }

    std::unique_ptr<Project> emptyProject(const std::string& name)
    {
        auto project = Project::create(name, session_.events(), session_.plugins());
        project->removeScene(*project->scenes().front());
        return project;
    }

    void convertOne(const fs::path& input, const fs::path& output)
    {
        std::unique_ptr<Project> project;
        if (isProject(input)) {
            session_.useProjectPlugins(input);
            project = Project::load(session_.readable(input), session_.events(), session_.plugins()).orThrow();
            for (const FormatNote& note : project->notes()) session_.warning(note.message, note.where);
            session_.comparePlugins(*project);
        } else {
            session_.compareWithSet();
            project = emptyProject(output.stem().string());
            importInto(project->addScene("Scene 0"), input);
        }
        if (isProject(output)) {
            saveProject(*project, output);
            return;
        }
        exportScene(chooseScene(*project, options_.scene), output);
    }

    // A project that has files is packed as it is, with its pictures and sounds; one just made, from a folder for it.
    static void saveProject(Project& project, const fs::path& output)
    {
        if (!isPacked(output)) return project.saveAs(output).orThrow();
        std::string folder = (fs::temp_directory_path() / "jet-convert-XXXXXX").string();
        const bool isNew = project.file().empty();
        if (isNew && !::mkdtemp(folder.data()))
            throw Failure(Error("no temporary folder can be made; free some space", Location{folder, 0, 0}));
        auto saved = isNew ? project.saveAs(folder) : Result<void>();
        if (saved) {
            const auto packed = packProject(project);
            saved = packed ? writeFileAtomically(output, packed->bytes) : Result<void>(packed.error());
        }
        std::error_code ignored;
        if (isNew) fs::remove_all(folder, ignored);
        saved.orThrow();
    }

    void importInto(Scene& scene, const fs::path& input)
    {
        const std::string extension = extensionOf(input);
        Importer* importer = session_.plugins().importer(extension);
        if (!importer)
            throw Failure(Error(session_.plugins().explain(ContributionKind::Importer, extension),
                                Location{input.string(), 0, 0}));
        const std::string content = readFile(input).orThrow();
        std::vector<FormatNote> notes;
        auto edit = scene.items().begin("Import");
        ImportRequest request{
            input, std::as_bytes(std::span(content.data(), content.size())), edit, scene.root(), notes, {}};
        const auto read = importer->read(request);
        for (FormatNote& note : notes) {
            if (note.where.file.empty()) note.where.file = input.string();
            session_.warning(note.message, note.where);
        }
        if (!read) throw Failure(read.error());
        applyEffects(edit, scene);
        applyProperties(edit, scene);
        edit.commit();
    }

    std::vector<const Item*> itemsOf(const Scene& scene) const
    {
        std::vector<const Item*> items;
        scene.root().walk([&](const Item& item) {
            if (item.parent()) items.push_back(&item);
        });
        return items;
    }

    void applyEffects(Transaction& edit, const Scene& scene)
    {
        for (const EffectRequest& request : effects_) {
            const Effect* effect = session_.plugins().effect(request.effect);
            if (!effect) throw Failure(Error(session_.plugins().explain(ContributionKind::Effect, request.effect)));
            Properties values;
            for (const auto& [id, text] : request.values) {
                const PropertySpec* spec = effect->properties().find(id);
                if (!spec) throw Failure(Error("the effect '" + request.effect + "' has no property '" + id + "'"));
                values.set(id, Value::parse(spec->kind, text).orThrow());
            }
            for (const Item* item : itemsOf(scene)) {
                if (item->isContainer() || item->path().isEmpty() || item->effect(request.effect)) continue;
                if (const std::string reason = effect->rejects(*item); !reason.empty()) {
                    session_.warning(reason);
                } else {
                    edit.addEffect(*item, request.effect, values);
                }
            }
        }
    }

    void applyProperties(Transaction& edit, const Scene& scene)
    {
        for (const auto& [id, text] : properties_) {
            bool used = false;
            for (const Item* item : itemsOf(scene)) {
                const ItemType* type = session_.plugins().itemType(item->type());
                const PropertySpec* spec = type ? type->properties().find(id) : nullptr;
                if (!spec) continue;
                edit.set(*item, id, Value::parse(spec->kind, text).orThrow());
                used = true;
            }
            if (used) continue;
            const PropertySpec* spec = Scene::settingsTable().find(id);
            if (!spec) throw Failure(Error("no item has a property '" + id + "', nor has the scene; check its name"));
            edit.setScene(id, Value::parse(spec->kind, text).orThrow());
        }
    }

    void exportScene(const Scene& scene, const fs::path& output)
    {
        const std::string extension = extensionOf(output);
        Exporter* exporter = session_.plugins().exporter(extension);
        if (!exporter)
            throw Failure(Error(session_.plugins().explain(ContributionKind::Exporter, extension),
                                Location{output.string(), 0, 0}));
        std::vector<FormatNote> notes;
        ExportRequest request{scene, nullptr, std::nullopt, options_.width, options_.height, background_, output,
                              notes, {}};
        auto content = exporter->write(request);
        for (const FormatNote& note : notes) session_.warning(note.message, note.where);
        if (!content) throw Failure(content.error());
        writeFileAtomically(output, std::span<const std::byte>(*content)).orThrow();
    }

    Session& session_;
    const ConvertOptions& options_;
    std::vector<EffectRequest> effects_;
    std::vector<std::pair<std::string, std::string>> properties_;
    std::optional<Color> background_;
};

}  // namespace

int convert(Session& session, const ConvertOptions& options) { return Converter(session, options).run(); }

}  // namespace jet::host
