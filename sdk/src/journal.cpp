#include "journal_state.hpp"
#include "project_files.hpp"
#include "system_error.hpp"

#include <jet/editor.hpp>
#include <jet/project_tree.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <unistd.h>

namespace jet {

namespace fs = std::filesystem;

fs::path journalFolder()
{
    if (const char* state = std::getenv("XDG_STATE_HOME"); state && *state == '/')
        return fs::path(state) / "jet/journals";
    const char* home = std::getenv("HOME");
    return home && *home ? fs::path(home) / ".local/state/jet/journals" : fs::path();
}

// --- JournalSyncer

void JournalSyncer::watch(int descriptor, const fs::path& folder)
{
    const std::lock_guard lock(mutex_);
    if (fd_ >= 0) ::close(fd_);
    fd_ = descriptor >= 0 ? ::dup(descriptor) : -1;
    folder_ = folder;
    newName_ = true;
    dirty_ = false;
}

void JournalSyncer::written()
{
    const std::lock_guard lock(mutex_);
    dirty_ = true;
    if (!thread_.joinable()) thread_ = std::thread([this] { run(); });
    wake_.notify_one();
}

void JournalSyncer::stop()
{
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
        wake_.notify_one();
    }
    if (thread_.joinable()) thread_.join();
    if (fd_ >= 0) ::close(fd_);
    fd_ = -1;
}

int JournalSyncer::problem()
{
    const std::lock_guard lock(mutex_);
    return std::exchange(problem_, 0);
}

void JournalSyncer::run()
{
    std::unique_lock lock(mutex_);
    for (;;) {
        wake_.wait(lock, [this] { return dirty_ || stopping_; });
        wake_.wait_for(lock, kSyncDelay, [this] { return stopping_; });
        if (dirty_ && fd_ >= 0) {
            dirty_ = false;
            const int fd = ::dup(fd_);  // stays open while the journal goes on to another file
            const bool newName = std::exchange(newName_, false);
            const fs::path folder = folder_;
            lock.unlock();
            int code = fd < 0 || ::fdatasync(fd) != 0 ? errno : 0;
            if (fd >= 0) ::close(fd);
            if (newName && code == 0 && !syncFolder(folder)) code = EIO;
            lock.lock();
            if (code != 0) problem_ = code;
        }
        if (stopping_) return;
    }
}

// --- what is recorded

Journal::Private::Private(Project& p, fs::path f) : project(p), folder(std::move(f))
{
    onProblem = [](const std::string& text) {
        if (!text.empty()) std::fprintf(stderr, "%s\n", text.c_str());
    };
    project.files_->watcher = this;
    trackAll();
    structure_ = structureText();
    auto& events = project.events_;
    subscriptions_.push_back(
        events.subscribe<ProjectChanged>(nullptr, [this](const ProjectChanged&) { recordStructure(); }));
    subscriptions_.push_back(
        events.subscribe<ProjectTreeChanged>(&project, [this](const ProjectTreeChanged&) { recordStructure(); }));
    // A scene nobody told of: it came into the tree by another way than Project::addScene().
    subscriptions_.push_back(events.subscribe<ItemsChanged>(nullptr, [this](const ItemsChanged& event) {
        if (!scenes_.contains(event.scene) && sceneOf(event.scene)) record(event);
    }));
}

Journal::Private::~Private()
{
    project.files_->watcher = nullptr;
    syncer.stop();
    if (writer && changes == 0) writer->remove();
}

Scene* Journal::Private::sceneOf(const Scene* scene) const
{
    const auto all = project.scenes();
    const auto found = std::ranges::find(all, scene);
    return found == all.end() ? nullptr : *found;
}

std::string Journal::Private::fileOf(const Scene& scene) const
{
    const auto found = project.sceneFiles_.find(&scene);
    return found == project.sceneFiles_.end() ? std::string() : found->second;
}

Journal::Private::Tracked& Journal::Private::track(Scene& scene)
{
    const auto [found, isNew] = scenes_.try_emplace(&scene);
    Tracked& tracked = found->second;
    if (!isNew) return tracked;
    tracked.key = nextKey_++;
    tracked.isAsFile =
        scene.undoRedo().isClean() && !project.files_->unsaved.contains(&scene) && !fileOf(scene).empty();
    // By its sender: such listeners hear first, so what another listener commits in turn is recorded after this.
    tracked.changed =
        project.events_.subscribe<ItemsChanged>(&scene, [this](const ItemsChanged& event) { record(event); });
    return tracked;
}

void Journal::Private::trackAll()
{
    const auto all = project.scenes();
    std::erase_if(scenes_, [&](const auto& entry) { return std::ranges::find(all, entry.first) == all.end(); });
    for (Scene* scene : all) track(*scene);
}

StructureRecord Journal::Private::structure()
{
    StructureRecord record;
    record.name = project.name(), record.start = startChoice(project).name();
    const auto fill = [&](const auto& self, const Filter& filter, StructureRecord::FilterEntry& into) -> void {
        into.name = filter.name;
        for (const auto& scene : filter.scenes)
            into.scenes.push_back({track(*scene).key, scene->name(), fileOf(*scene)});
        for (const auto& inner : filter.filters) self(self, *inner, into.filters.emplace_back());
    };
    fill(fill, project.root(), record.root);
    return record;
}

std::string Journal::Private::structureText() { return structure().encode(); }

HeadRecord Journal::Private::head() const
{
    HeadRecord head;
    std::error_code ignored;
    if (!project.file().empty()) head.project = fs::absolute(project.file(), ignored).string();
    head.name = project.name();
    head.time = millisecondsNow();
    head.process = static_cast<std::uint64_t>(::getpid());
    const auto known = project.files_->known.find(project.file().filename().string());
    if (known != project.files_->known.end()) head.projectHash = known->second.hash;
    return head;
}

Result<void> Journal::Private::append(RecordKind kind, const std::string& content)
{
    return writer->append(kind, content);
}

// Head and tree; the scenes' bases follow when they change.
Result<void> Journal::Private::begin()
{
    if (folder.empty()) return Error("there is no folder for journals: neither XDG_STATE_HOME nor HOME is set");
    std::string name;
    for (const char c : project.name().substr(0, 40))
        name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
    std::random_device random;
    file = folder / (name + "-" + std::to_string(::getpid()) + "-" + std::to_string(random()) + ".journal");
    auto made = std::make_unique<JournalWriter>();
    if (auto created = made->create(file); !created) return created;
    const auto give = [&](RecordKind kind, const std::string& content) { return made->append(kind, content); };
    if (auto done = give(RecordKind::Head, head().encode()); !done) return made->remove(), done;
    if (auto done = give(RecordKind::Structure, structure_); !done) return made->remove(), done;
    if (auto done = made->publish(false); !done) return made->remove(), done;
    writer = std::move(made);
    snapshotSize_ = 0;
    for (auto& [scene, tracked] : scenes_) tracked.based = false;
    syncer.watch(writer->descriptor(), folder);
    return appendNewScenes();
}

// Scenes that are in no file: only the journal has them.
Result<void> Journal::Private::appendNewScenes()
{
    bool isBefore = false;
    for (Scene* scene : project.scenes()) {
        Tracked& tracked = track(*scene);
        if (tracked.based || tracked.isAsFile) continue;
        if (auto done = appendBase(*scene, tracked, isBefore); !done) return done;
    }
    return {};
}

BaseRecord Journal::Private::baseOf(const Scene& scene, Tracked& tracked) const
{
    BaseRecord base;
    base.scene = tracked.key, base.file = fileOf(scene);
    const auto known = project.files_->known.find(base.file);
    if (known != project.files_->known.end() && !base.file.empty()) base.fileHash = known->second.hash;
    tracked.fileHash = base.fileHash;
    return base;
}

// The scene before its first change, if its file still holds that; else as it is now, the change in it.
Result<void> Journal::Private::appendBase(Scene& scene, Tracked& tracked, bool& isBefore)
{
    BaseRecord base = baseOf(scene, tracked);
    isBefore = false;
    if (tracked.isAsFile) {
        auto text = readFile(project.folder() / base.file);
        if (text && contentHash(*text) == base.fileHash) {
            base.text = std::move(*text);
            isBefore = true;
        }
    }
    if (!isBefore) base.text = writeSceneText(scene);
    auto done = append(RecordKind::Base, base.encode());
    if (done) tracked.based = true, tracked.isAsFile = false;
    return done;
}

void Journal::Private::record(const ItemsChanged& event)
{
    Scene* scene = sceneOf(event.scene);
    if (!scene) return;
    const bool based = writer && track(*scene).based;
    recordStructure();
    recordChanges(*scene, event, based);
}

void Journal::Private::recordChanges(Scene& scene, const ItemsChanged& event, bool based)
{
    ++changes;
    if (broken_) return beginAnew();
    if (const int code = syncer.problem(); code != 0) return failed(systemError(file, "cannot be written", code));
    if (!writer)
        if (const auto begun = begin(); !begun) return failed(begun.error());
    Tracked& tracked = scenes_.at(&scene);
    ChangesRecord record{millisecondsNow(), tracked.key, 1, {}};
    bool isBefore = based;  // else a base written meanwhile holds the change already
    if (!tracked.based)
        if (const auto done = appendBase(scene, tracked, isBefore); !done) return failed(done.error());
    if (isBefore) record.changes = encodeChanges(scene, event.changes, event.cause);
    if (const auto done = append(RecordKind::Changes, record.encode()); !done) return failed(done.error());
    afterAppend();
}

void Journal::Private::recordStructure()
{
    trackAll();
    StructureRecord now = structure();
    std::string text = now.encode();
    if (text == structure_) return;
    ++changes;
    if (broken_) return beginAnew();
    if (!writer)
        if (const auto begun = begin(); !begun) return failed(begun.error());
    now.time = millisecondsNow();
    if (const auto done = appendNewScenes(); !done) return failed(done.error());
    if (const auto done = append(RecordKind::Tree, now.encode()); !done) return failed(done.error());
    structure_ = std::move(text);
    afterAppend();
}

void Journal::Private::afterAppend()
{
    syncer.written();
    if (writer->size() < compactionSize || writer->size() < 4 * snapshotSize_) return;
    if (const auto done = snapshot(); !done) failed(done.error());
}

// --- beginning anew

Result<void> Journal::Private::writeSnapshot(JournalWriter& to)
{
    trackAll();
    structure_ = structureText();
    if (auto done = to.append(RecordKind::Head, head().encode()); !done) return done;
    if (auto done = to.append(RecordKind::Structure, structure_); !done) return done;
    for (Scene* scene : project.scenes()) {
        const bool clean = scene->undoRedo().isClean() && !project.files_->unsaved.contains(scene);
        if (clean && !fileOf(*scene).empty()) continue;
        BaseRecord base = baseOf(*scene, track(*scene));
        base.text = writeSceneText(*scene);
        if (auto done = to.append(RecordKind::Base, base.encode()); !done) return done;
    }
    return to.append(RecordKind::Changes, ChangesRecord{millisecondsNow(), 0, changes, {}}.encode());
}

Result<void> Journal::Private::snapshot()
{
    if (!writer && file.empty()) {
        if (auto begun = begin(); !begun) return begun;
    }
    auto made = std::make_unique<JournalWriter>();
    auto done = made->create(file);
    if (done) done = writeSnapshot(*made);
    if (done) done = made->publish(true);
    if (!done) return made->remove(), done;
    writer = std::move(made);
    snapshotSize_ = writer->size();
    for (auto& [scene, tracked] : scenes_) {
        const Scene* present = sceneOf(scene);
        const bool clean = present && present->undoRedo().isClean() && !project.files_->unsaved.contains(present);
        tracked.isAsFile = clean && !fileOf(*present).empty();
        tracked.based = !tracked.isAsFile;
    }
    syncer.watch(writer->descriptor(), folder);
    return {};
}

void Journal::Private::failed(const Error& error)
{
    if (!broken_)
        onProblem(
            Error("changes can not be recorded for a recovery: " + error.message + ". Save soon", error.where).text());
    broken_ = true;
    lastTry_ = std::chrono::steady_clock::now();
}

// With the whole state, which holds what could not be recorded; at most every two seconds.
void Journal::Private::beginAnew()
{
    if (std::chrono::steady_clock::now() - lastTry_ < std::chrono::seconds(2)) return;
    lastTry_ = std::chrono::steady_clock::now();
    if (!snapshot()) return;
    broken_ = false;
    onProblem({});
}

void Journal::Private::aboutToSave(std::span<const FileToWrite> files, bool elsewhere)
{
    if (!writer || elsewhere || broken_) return;
    recordStructure();  // the files of new scenes have their names now
    if (const auto done = appendBasesOfTakenFiles(files); !done) return failed(done.error());
    SaveRecord record;
    for (const FileToWrite& written : files) {
        const auto tracked = scenes_.find(written.scene);
        if (written.scene && tracked == scenes_.end()) continue;
        record.files.emplace_back(written.scene ? tracked->second.key : 0, written.hash);
    }
    const auto done = append(RecordKind::Save, record.encode());
    if (!done) return failed(done.error());
    // On the disk, with its name, before the first file is replaced: a power cut between two files leaves the journal.
    auto synced = writer->sync();
    if (synced) synced = syncFolder(folder);
    if (!synced) failed(synced.error());
}

// A new scene may get the file of one that was removed. Ending before it is written, that file holds what nobody else
// wrote, although nothing the journal tells of this scene explains it: its base is told again, with that file.
Result<void> Journal::Private::appendBasesOfTakenFiles(std::span<const FileToWrite> files)
{
    for (const FileToWrite& written : files) {
        const auto tracked = scenes_.find(written.scene);
        const auto known = project.files_->known.find(written.path);
        if (tracked == scenes_.end() || !tracked->second.based || known == project.files_->known.end()) continue;
        if (known->second.hash == tracked->second.fileHash) continue;
        BaseRecord base = baseOf(*written.scene, tracked->second);
        base.text = written.content;
        if (auto done = append(RecordKind::Base, base.encode()); !done) return done;
    }
    return {};
}

void Journal::Private::saved() { discard(); }

void Journal::Private::discard()
{
    if (writer) writer->remove();
    writer.reset();
    syncer.watch(-1, {});
    file.clear();
    changes = 0;
    if (broken_) onProblem({});
    broken_ = false;
    scenes_.clear();
    trackAll();
    structure_ = structureText();
}

// --- Journal

Journal::Journal(Project& project, fs::path folder) : d_(std::make_unique<Private>(project, std::move(folder))) {}
Journal::~Journal() = default;

const fs::path& Journal::file() const { return d_->file; }
std::size_t Journal::changeCount() const { return d_->changes; }
void Journal::discard() { d_->discard(); }
void Journal::recordStructure() { d_->recordStructure(); }
Result<void> Journal::recordEverything(std::size_t unsaved)
{
    d_->changes = std::max<decltype(d_->changes)>(d_->changes, unsaved);
    return d_->snapshot();
}
void Journal::sync()
{
    if (d_->writer) (void)d_->writer->sync();
}
void Journal::setProblemHandler(std::function<void(const std::string&)> handler) { d_->onProblem = std::move(handler); }
void Journal::setCompactionSize(std::uintmax_t bytes) { d_->compactionSize = bytes; }

}  // namespace jet
