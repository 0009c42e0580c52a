// Files and folders written so that they survive a power cut, and errors of the disk as sentences.
#pragma once

#include <jet/result.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace jet::host {

/// "FILE: error: what: No space left on device; free some space".
Error diskError(const std::filesystem::path& file, const std::string& what, int code);

/// A file that did not exist before; in folders made for it.
class NewFile {
public:
    /// `name` is relative to `folder`; never follows a link.
    static Result<std::unique_ptr<NewFile>> create(const std::filesystem::path& folder, const std::string& name,
                                                   bool executable);
    ~NewFile();
    NewFile(const NewFile&) = delete;
    NewFile& operator=(const NewFile&) = delete;

    Result<void> write(std::string_view part);
    /// Syncs and closes.
    Result<void> finish();

private:
    NewFile(std::filesystem::path path, int fd) : path_(std::move(path)), fd_(fd) {}
    std::filesystem::path path_;
    int fd_;
};

/// The names in this folder and those below.
Result<void> syncFolders(const std::filesystem::path& folder);
Result<void> syncFolder(const std::filesystem::path& folder);

/// Puts `from` in the place of `to`; what was there is then at `from`. Both exist; at no moment is `to` missing where
/// the file system can exchange names.
Result<void> exchange(const std::filesystem::path& from, const std::filesystem::path& to);

/// Holds a lock file while it lives. Waits for no one.
class FolderLock {
public:
    /// An error if another program holds it, or if the file cannot be made.
    static Result<std::unique_ptr<FolderLock>> take(const std::filesystem::path& file);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

private:
    explicit FolderLock(int fd) : fd_(fd) {}
    int fd_;
};

}  // namespace jet::host
