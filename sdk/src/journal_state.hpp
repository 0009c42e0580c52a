// What a live journal keeps.
#pragma once

#include "journal_file.hpp"
#include "project_files.hpp"

#include <condition_variable>
#include <mutex>
#include <thread>

namespace jet {

/// Calls fdatasync in a thread of its own, kSyncDelay after something was written. A disk that is slow stops nobody.
class JournalSyncer {
public:
    JournalSyncer() = default;
    ~JournalSyncer() { stop(); }
    JournalSyncer(const JournalSyncer&) = delete;
    JournalSyncer& operator=(const JournalSyncer&) = delete;

    /// From now on this file, through a descriptor of its own.
    void watch(int descriptor, const std::filesystem::path& folder);
    void written();
    void stop();
    /// An error number of a sync that failed since the last call; 0: none.
    int problem();

private:
    void run();
    std::thread thread_;
    std::mutex mutex_;
    std::condition_variable wake_;
    int fd_ = -1;
    std::filesystem::path folder_;
    bool dirty_ = false, newName_ = false, stopping_ = false;
    int problem_ = 0;
};

class Journal::Private final : public ProjectWatcher {
public:
    Private(Project& p, std::filesystem::path f);
    ~Private() override;

    void sceneAdded(Scene& scene) override
    {
        scenes_.erase(&scene);  // what another scene at this address was, before anybody told of its end
        track(scene);
    }
    void aboutToSave(std::span<const FileToWrite> files, bool elsewhere) override;
    void saved() override;

    void recordStructure();
    Result<void> snapshot();
    void discard();
    Scene* sceneOf(const Scene* scene) const;

    Project& project;
    std::filesystem::path folder;
    std::unique_ptr<JournalWriter> writer;
    std::filesystem::path file;
    JournalSyncer syncer;
    std::size_t changes = 0;
    std::uintmax_t compactionSize = 32U << 20;
    std::function<void(const std::string&)> onProblem;

private:
    struct Tracked {
        SceneKey key = 0;
        bool isAsFile = false;       ///< before its next change it is what its file holds
        bool based = false;          ///< its base is in the journal
        std::uint64_t fileHash = 0;  ///< of its file, as its base tells it
        Subscription changed;
    };

    Tracked& track(Scene& scene);
    void trackAll();
    void record(const ItemsChanged& event);
    void recordChanges(Scene& scene, const ItemsChanged& event, bool based);
    Result<void> begin();
    Result<void> appendNewScenes();
    Result<void> append(RecordKind kind, const std::string& content);
    Result<void> appendBase(Scene& scene, Tracked& tracked, bool& isBefore);
    BaseRecord baseOf(const Scene& scene, Tracked& tracked) const;
    Result<void> appendBasesOfTakenFiles(std::span<const FileToWrite> files);
    Result<void> writeSnapshot(JournalWriter& to);
    void failed(const Error& error);
    void beginAnew();
    void afterAppend();
    HeadRecord head() const;
    StructureRecord structure();
    std::string structureText();
    std::string fileOf(const Scene& scene) const;

    std::map<const Scene*, Tracked> scenes_;
    SceneKey nextKey_ = 1;
    std::string structure_;  // as recorded last, without its time
    std::uintmax_t snapshotSize_ = 0;
    bool broken_ = false;  // something could not be recorded: the file must be begun anew
    std::chrono::steady_clock::time_point lastTry_;
    std::vector<Subscription> subscriptions_;
};

}  // namespace jet
