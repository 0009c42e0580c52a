// The file of a journal: a head, then records of a kind, each with its length and a checksum over kind, number and
// content, so that a torn or foreign tail is recognised.
#pragma once

#include "journal_bytes.hpp"

#include <jet/journal.hpp>

namespace jet {

// Journals on disk know these numbers: add, never change.
enum class RecordKind : std::uint8_t {
    Head = 1,   ///< project file (absolute), project name, time, process
    Structure,  ///< the tree of filters and scenes
    Base,       ///< a scene as it was before its first change: file, its hash, its content
    Changes,    ///< time, scene, how many commits, undos and redos it stands for, encoded changes
    Save,       ///< a save is about to write these files: scene (0: project.jet), hash
    Tree,       ///< as Structure: somebody changed it
};

struct Record {
    RecordKind kind;
    std::string content;
};

std::int64_t millisecondsNow();

/// What identifies the scene within its journal.
using SceneKey = std::uint64_t;

struct HeadRecord {
    std::string project, name;
    std::int64_t time = 0;  ///< milliseconds since 1970
    std::uint64_t process = 0;
    std::uint64_t projectHash = 0;  ///< content of project.jet; 0: none
    std::string encode() const;
    static HeadRecord decode(std::string_view bytes);
};

struct BaseRecord {
    SceneKey scene = 0;
    std::string file;            ///< relative to the project's folder; empty: never saved
    std::uint64_t fileHash = 0;  ///< content of that file when the base was taken; 0: none
    std::string text;            ///< the scene's text; its hash is fileHash where the scene was as saved
    std::string encode() const;
    static BaseRecord decode(std::string_view bytes);
};

struct SaveRecord {
    std::vector<std::pair<SceneKey, std::uint64_t>> files;
    std::string encode() const;
    static SaveRecord decode(std::string_view bytes);
};

struct ChangesRecord {
    std::int64_t time = 0;  ///< milliseconds since 1970
    SceneKey scene = 0;
    std::uint64_t count = 1;
    std::string changes;
    std::string encode() const;
    static ChangesRecord decode(std::string_view bytes);
};

/// The tree as nested filters; a scene is its key, name and file.
struct StructureRecord {
    struct SceneEntry {
        SceneKey key = 0;
        std::string name, file;
    };
    struct FilterEntry {
        std::string name;
        std::vector<SceneEntry> scenes;
        std::vector<FilterEntry> filters;
    };
    std::int64_t time = 0;
    std::string name;
    FilterEntry root;
    std::string start;  ///< name of the start scene; empty: none chosen. Last, and not in older journals
    std::string encode() const;
    static StructureRecord decode(std::string_view bytes);
};

/// Appends records. Every append leaves the file whole or as it was.
class JournalWriter {
public:
    ~JournalWriter();
    JournalWriter() = default;
    JournalWriter(const JournalWriter&) = delete;
    JournalWriter& operator=(const JournalWriter&) = delete;

    /// A new file that others see as in use. It has a name of its own until publish().
    Result<void> create(const std::filesystem::path& file);
    Result<void> append(RecordKind kind, std::string_view content);
    /// Gives the file its name, in place of an older one; before that, syncs it if the older one must not be lost.
    Result<void> publish(bool synced);
    Result<void> sync();
    std::uintmax_t size() const { return size_; }
    bool isOpen() const { return fd_ >= 0; }
    /// Closes, and removes the file.
    void remove();
    const std::filesystem::path& file() const { return file_; }
    int descriptor() const { return fd_; }

private:
    std::filesystem::path temporary() const;
    void close();
    std::filesystem::path file_;
    int fd_ = -1;
    std::uint64_t number_ = 0;
    std::uintmax_t size_ = 0;
    bool published_ = false;
    bool broken_ = false;  // half a record is in it, and could not be taken back
};

/// Reads records up to the end or the first that is damaged.
class JournalReader {
public:
    Result<void> open(const std::filesystem::path& file);
    /// The next record; nothing at the end. Without content the checksum is not looked at, the length is.
    std::optional<Record> next(bool withContent = true);
    bool torn() const { return torn_; }
    /// Another process has it open for writing.
    bool inUse() const { return inUse_; }
    ~JournalReader();
    JournalReader() = default;
    JournalReader(const JournalReader&) = delete;
    JournalReader& operator=(const JournalReader&) = delete;

private:
    int fd_ = -1;
    std::uint64_t at_ = 0, size_ = 0, number_ = 0;
    bool torn_ = false, inUse_ = false;
};

}  // namespace jet
