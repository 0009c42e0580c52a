// Finding journals, and making a project of one.
//
// A scene's file on disk is one of three: what the journal began with, what one of its saves wrote (the process ended
// between writing it and forgetting the changes), or something else, which another program wrote. The first two are
// told by their hashes, and the changes that are not yet in the file are made in it. For the third the scene comes from
// the journal alone, and saving it will ask, since the file is not what it was based on.
#include "journal_file.hpp"
#include "project_files.hpp"

#include <jet/journal.hpp>

#include <algorithm>
#include <unistd.h>

namespace jet {

namespace fs = std::filesystem;

namespace {

// A damaged record may hold any number: the clock's nanoseconds reach from 1678 to 2262.
std::chrono::system_clock::time_point timeOf(std::int64_t ms)
{
    constexpr std::int64_t kFarthest = 9'200'000'000'000;
    return std::chrono::system_clock::time_point(std::chrono::milliseconds(std::clamp(ms, -kFarthest, kFarthest)));
}

/// A scene's part of a journal: what it was, and what happened to it, in order.
struct SceneHistory {
    std::optional<BaseRecord> base;
    struct Step {
        std::uint64_t count = 0;  // changes; 0: a save
        std::string changes;
        std::uint64_t savedHash = 0;
    };
    std::vector<Step> steps;
};

struct Contents {
    HeadRecord head;
    StructureRecord structure;
    std::map<SceneKey, SceneHistory> scenes;
    std::vector<std::uint64_t> savedProjects;  // hashes of project.jet that were about to be written
    std::size_t changes = 0;
    bool torn = false;
};

void take(Contents& contents, Record& record)
{
    switch (record.kind) {
    case RecordKind::Head: contents.head = HeadRecord::decode(record.content); return;
    case RecordKind::Tree: ++contents.changes; [[fallthrough]];
    case RecordKind::Structure: contents.structure = StructureRecord::decode(record.content); return;
    case RecordKind::Base: {
        BaseRecord base = BaseRecord::decode(record.content);
        SceneHistory& history = contents.scenes[base.scene];
        history = {std::move(base), {}};  // a second one holds all that was done before
        return;
    }
    case RecordKind::Changes: {
        ChangesRecord changes = ChangesRecord::decode(record.content);
        contents.changes += static_cast<std::size_t>(changes.count);
        contents.scenes[changes.scene].steps.push_back({changes.count, std::move(changes.changes), 0});
        return;
    }
    case RecordKind::Save:
        for (const auto& [scene, hash] : SaveRecord::decode(record.content).files) {
            if (scene == 0) {
                contents.savedProjects.push_back(hash);
            } else {
                contents.scenes[scene].steps.push_back({0, {}, hash});
            }
        }
        return;
    }
    ByteReader::fail("it holds a kind of record this JET does not know; open it with a newer JET");
}

Result<Contents> readContents(const fs::path& file)
{
    JournalReader reader;
    if (auto opened = reader.open(file); !opened) return opened.error();
    Contents contents;
    try {
        bool first = true;
        while (auto record = reader.next()) {
            if (first && record->kind != RecordKind::Head) ByteReader::fail("it has no head");
            first = false;
            take(contents, *record);
        }
        if (first) ByteReader::fail("it is empty");
    } catch (const Failure& failure) {
        return Error(failure.error().message, Location{file.string(), 0, 0});
    }
    contents.torn = reader.torn();
    return contents;
}

}  // namespace

// --- finding

Result<JournalInfo> inspectJournal(const fs::path& file)
{
    JournalReader reader;
    if (auto opened = reader.open(file); !opened) return opened.error();
    JournalInfo info;
    info.file = file;
    info.inUse = reader.inUse();
    const auto headRecord = reader.next();
    if (!headRecord || headRecord->kind != RecordKind::Head)
        return Error("this journal has no head; it was torn when it was begun, and holds nothing",
                     Location{file.string(), 0, 0});
    try {
        const HeadRecord head = HeadRecord::decode(headRecord->content);
        info.project = head.project, info.name = head.name;
        std::int64_t last = head.time;
        while (const auto record = reader.next(false)) {
            if (record->kind != RecordKind::Changes && record->kind != RecordKind::Tree) continue;
            ByteReader in(record->content);
            last = static_cast<std::int64_t>(in.bits());
            if (record->kind == RecordKind::Changes) in.number();
            info.changes += record->kind == RecordKind::Tree ? 1 : static_cast<std::size_t>(in.number());
        }
        info.lastChange = timeOf(last);
    } catch (const Failure& failure) {
        return Error(failure.error().message, Location{file.string(), 0, 0});
    }
    info.torn = reader.torn();
    return info;
}

std::vector<JournalInfo> findJournals(const fs::path& folder)
{
    std::vector<JournalInfo> found;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
        if (entry.path().extension() != ".journal") continue;
        const auto info = inspectJournal(entry.path());
        if (info && info->changes > 0) found.push_back(*info);
    }
    std::ranges::sort(found, std::greater(), &JournalInfo::lastChange);
    return found;
}

std::vector<JournalInfo> findJournals(const Project& project, const fs::path& folder)
{
    std::error_code ignored;
    const fs::path file = fs::weakly_canonical(fs::absolute(project.file(), ignored), ignored);
    std::vector<JournalInfo> found = findJournals(folder);
    std::erase_if(found, [&](const JournalInfo& info) {
        return info.inUse || project.file().empty() || fs::weakly_canonical(info.project, ignored) != file;
    });
    return found;
}

Result<void> Journal::remove(const fs::path& file)
{
    JournalReader reader;
    if (auto opened = reader.open(file); opened && reader.inUse())
        return Error("a running editor writes this journal; close that first", Location{file.string(), 0, 0});
    std::error_code problem;
    fs::remove(file, problem);
    if (problem) return Error("cannot be removed: " + problem.message(), Location{file.string(), 0, 0});
    return {};
}

// --- recovering

class ProjectRecovery {
public:
    ProjectRecovery(Contents contents, EventsCenter& events, Catalog& catalog)
        : contents_(std::move(contents)), events_(events), catalog_(catalog)
    {
    }

    Recovery run()
    {
        openProject();
        indexOpened();
        Project& project = *recovery_.project;
        project.name_ = contents_.structure.name;
        Filter root;
        buildFilter(contents_.structure.root, root);
        keepForeign(root);
        project.root_ = std::move(root);
        startChoice(project) = startCalled(project, contents_.structure.start);
        for (Scene* scene : project.scenes()) scene->setAssetFolder(project.folder().string());
        if (contents_.torn)
            note("The last record of the journal is incomplete: the change that was under way is not in it.");
        recovery_.changes = contents_.changes - lost_;
        return std::move(recovery_);
    }

private:
    void note(std::string text) { recovery_.notes.push_back(std::move(text)); }

    void openProject()
    {
        const fs::path file = contents_.head.project;
        if (!file.empty()) {
            auto loaded = Project::load(file, events_, catalog_);
            if (loaded) {
                recovery_.project = std::move(*loaded);
                return;
            }
            note("The project cannot be opened (" + loaded.error().text() +
                 "). What was changed comes from the journal; save it in another place.");
        }
        recovery_.project.reset(new Project(events_, catalog_));
    }

    void indexOpened()
    {
        Project& project = *recovery_.project;
        const auto collect = [&](const auto& self, Filter& filter) -> void {
            for (auto& scene : filter.scenes) {
                const std::string file = project.sceneFiles_[scene.get()];
                opened_.emplace(file, std::move(scene));
            }
            for (auto& inner : filter.filters) self(self, *inner);
        };
        collect(collect, project.root_);
    }

    void buildFilter(const StructureRecord::FilterEntry& entry, Filter& filter)
    {
        filter.name = entry.name;
        for (const auto& scene : entry.scenes)
            if (auto built = buildScene(scene)) filter.scenes.push_back(std::move(built));
        for (const auto& inner : entry.filters) {
            filter.filters.push_back(std::make_unique<Filter>());
            buildFilter(inner, *filter.filters.back());
        }
    }

    std::unique_ptr<Scene> takeOpened(const std::string& file)
    {
        const auto found = opened_.find(file);
        if (file.empty() || found == opened_.end()) return nullptr;
        auto scene = std::move(found->second);
        opened_.erase(found);
        return scene;
    }

    std::unique_ptr<Scene> buildScene(const StructureRecord::SceneEntry& entry)
    {
        auto scene = takeOpened(entry.file);
        const auto history = contents_.scenes.find(entry.key);
        if (history != contents_.scenes.end() && history->second.base) {
            scene = withChanges(std::move(scene), entry, history->second);
        } else if (!scene) {
            note("The scene '" + entry.name + "' was not changed, and its file '" + entry.file +
                 "' is not there any more: it is left out.");
            return nullptr;
        }
        if (scene) scene->setName(entry.name);
        return scene;
    }

    std::unique_ptr<Scene> withChanges(std::unique_ptr<Scene> opened, const StructureRecord::SceneEntry& entry,
                                       const SceneHistory& history)
    {
        Project& project = *recovery_.project;
        const BaseRecord& base = *history.base;
        const auto known = project.files_->known.find(entry.file);
        const std::uint64_t onDisk = opened && known != project.files_->known.end() ? known->second.hash : 0;
        std::size_t from = 0;
        if (onDisk != 0 && onDisk != base.fileHash) {
            for (std::size_t i = history.steps.size(); i-- > 0 && from == 0;)
                if (history.steps[i].count == 0 && history.steps[i].savedHash == onDisk) from = i + 1;
            if (from == 0) {
                note("The file of the scene '" + entry.name +
                     "' was changed by another program since. The recovered scene is what it was in JET; saving asks "
                     "before it replaces the file.");
                known->second.hash = base.fileHash, known->second.modified = 0;
            }
        }
        const bool asFile = onDisk != 0 && (from > 0 || contentHash(base.text) == onDisk);
        if (!asFile) opened = fromJournal(std::move(opened), entry, base);
        return opened ? replay(std::move(opened), entry.name, history, from) : nullptr;
    }

    // The scene as the journal has it; it differs from its file, whatever its history says.
    std::unique_ptr<Scene> fromJournal(std::unique_ptr<Scene> opened, const StructureRecord::SceneEntry& entry,
                                       const BaseRecord& base)
    {
        auto scene = readSceneText(base.text, "the journal's scene '" + entry.name + "'", events_, catalog_,
                                   recovery_.project->notes_);
        if (scene) return replaced(std::move(opened), std::move(*scene));
        note("The scene '" + entry.name + "' cannot be read from the journal: " + scene.error().text());
        return opened;
    }

    // The new one has the old one's file, and has to be written.
    std::unique_ptr<Scene> replaced(const std::unique_ptr<Scene>& old, std::unique_ptr<Scene> scene)
    {
        Project& project = *recovery_.project;
        if (old) {
            if (const auto file = project.sceneFiles_.find(old.get()); file != project.sceneFiles_.end()) {
                project.sceneFiles_[scene.get()] = file->second;
                project.sceneFiles_.erase(old.get());
            }
            project.files_->unsaved.erase(old.get());
        }
        project.files_->unsaved.insert(scene.get());
        return scene;
    }

    std::unique_ptr<Scene> replay(std::unique_ptr<Scene> scene, const std::string& name, const SceneHistory& history,
                                  std::size_t from)
    {
        std::vector<std::string_view> records;
        std::vector<std::uint64_t> counts;
        for (std::size_t i = from; i < history.steps.size(); ++i) {
            const auto& step = history.steps[i];
            if (step.count == 0 || step.changes.empty()) continue;
            records.push_back(step.changes), counts.push_back(step.count);
        }
        if (records.empty()) return scene;
        ReplayedScene made = replayChanges(*scene, records);
        if (made.records < records.size()) {
            std::size_t left = 0;
            for (std::size_t i = made.records; i < counts.size(); ++i) left += static_cast<std::size_t>(counts[i]);
            lost_ += left;
            note("The last " + std::to_string(left) + " changes of the scene '" + name +
                 "' cannot be recovered: " + made.problem.message + ".");
        }
        return replaced(scene, std::move(made.scene));
    }

    // Scenes of the opened project that the journal's tree does not have: removed by the user, or added by another
    // program to a project.jet the journal knows nothing of.
    void keepForeign(Filter& root)
    {
        Project& project = *recovery_.project;
        const auto known = project.files_->known.find(project.file_.filename().string());
        const std::uint64_t onDisk = known == project.files_->known.end() ? 0 : known->second.hash;
        const bool foreign = onDisk != 0 && onDisk != contents_.head.projectHash &&
                             std::ranges::find(contents_.savedProjects, onDisk) == contents_.savedProjects.end();
        for (auto& [file, scene] : opened_) {
            if (foreign) {
                note("The scene '" + scene->name() + "' was added by another program since; it is kept.");
                root.scenes.push_back(std::move(scene));
            } else {
                project.obsoleteFiles_.emplace_back(file);
                project.sceneFiles_.erase(scene.get());
            }
        }
    }

    Contents contents_;
    EventsCenter& events_;
    Catalog& catalog_;
    Recovery recovery_;
    std::map<std::string, std::unique_ptr<Scene>> opened_;  // by file
    std::size_t lost_ = 0;
};

Result<Recovery> recoverProject(const fs::path& journal, EventsCenter& events, Catalog& catalog)
{
    auto contents = readContents(journal);
    if (!contents) return contents.error();
    try {
        return ProjectRecovery(std::move(*contents), events, catalog).run();
    } catch (const Failure& failure) {
        return failure.error();
    }
}

}  // namespace jet
