// A library to preload: a disk that fails, or a power cut, at a chosen call.
//
//   JET_FAULT_FOLDER=DIR     only calls about files in DIR count
//   JET_FAULT_AT=N           the N-th such call (from 1) fails; 0: none
//   JET_FAULT_ERRNO=E        with this error number
//   JET_FAULT_STICKY=1       and all later ones, too: a disk that stays full
//   JET_FAULT_COUNT=FILE     at the end, the number of calls goes here
//   JET_FAULT_POWER=undo     instead: the power is cut before call N; new names that were not synced are gone
//   JET_FAULT_POWER=empty    ... or are there, but the files that were not synced are empty
//
// Counted: open for writing, write, pwrite, sendfile, copy_file_range, fsync, fdatasync, ftruncate, close, rename,
// link, unlink, mkdir.
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>
#include <vector>

namespace {

template <class F>
F next(const char* name)
{
    return reinterpret_cast<F>(dlsym(RTLD_NEXT, name));
}

std::string variable(const char* name)
{
    const char* value = std::getenv(name);
    return value ? value : "";
}

/// What a power cut takes back, the latest last.
struct NewName {
    std::string folder, path;
    std::string old;  // where the file that had the name is kept; empty: there was none
};

struct Injector {
    std::string folder = variable("JET_FAULT_FOLDER");
    long at = std::atol(variable("JET_FAULT_AT").c_str());
    int code = std::atoi(variable("JET_FAULT_ERRNO").c_str());
    bool sticky = variable("JET_FAULT_STICKY") == "1";
    std::string power = variable("JET_FAULT_POWER");
    std::string countFile = variable("JET_FAULT_COUNT");
    std::atomic<long> calls{0};
    std::recursive_mutex mutex;
    std::map<std::pair<dev_t, ino_t>, std::string> unsynced;  // files with data that is not on the disk
    std::vector<NewName> names;
    int kept = 0;

    ~Injector()
    {
        if (countFile.empty()) return;
        const std::string text = std::to_string(calls.load());
        const int fd =
            next<int (*)(const char*, int, ...)>("open")(countFile.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
        (void)!next<ssize_t (*)(int, const void*, size_t)>("write")(fd, text.data(), text.size());
    }

    bool concerns(const std::string& path) const
    {
        return !folder.empty() && path.compare(0, folder.size(), folder) == 0;
    }
    static std::string pathOf(int fd)
    {
        char link[64], path[4096];
        std::snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
        const ssize_t n = readlink(link, path, sizeof path);
        return n > 0 ? std::string(path, static_cast<size_t>(n)) : std::string();
    }
    /// Counts the call; true: it has to fail, errno says why.
    bool fails(const std::string& path)
    {
        if (!concerns(path)) return false;
        const std::lock_guard lock(mutex);
        const long n = ++calls;
        if (at <= 0 || n < at || (n > at && !sticky)) return false;
        if (!power.empty()) cutPower();
        errno = code;
        return true;
    }
    [[noreturn]] void cutPower()
    {
        if (power == "empty") {
            for (const auto& [file, path] : unsynced) (void)!truncate(path.c_str(), 0);
        } else {
            for (auto name = names.rbegin(); name != names.rend(); ++name) {
                next<int (*)(const char*)>("unlink")(name->path.c_str());
                if (!name->old.empty())
                    next<int (*)(const char*, const char*)>("rename")(name->old.c_str(), name->path.c_str());
            }
        }
        _exit(99);
    }

    void written(int fd)
    {
        struct stat info;
        if (power.empty() || fstat(fd, &info) != 0) return;
        const std::lock_guard lock(mutex);
        unsynced[{info.st_dev, info.st_ino}] = pathOf(fd);
    }
    void synced(int fd)
    {
        struct stat info;
        if (power.empty() || fstat(fd, &info) != 0) return;
        const std::lock_guard lock(mutex);
        unsynced.erase({info.st_dev, info.st_ino});
        if (!S_ISDIR(info.st_mode)) return;
        const std::string path = pathOf(fd);
        std::erase_if(names, [&](const NewName& name) { return name.folder == path; });
    }
    static std::string folderOf(const std::string& path) { return path.substr(0, path.rfind('/')); }

    /// Before the name gets another file, or none: keeps the present one aside, outside of what counts.
    void nameChanges(const std::string& path)
    {
        if (power.empty()) return;
        const std::lock_guard lock(mutex);
        NewName name{folderOf(path), path, {}};
        const std::string aside = folder + "-kept-" + std::to_string(kept++);
        if (next<int (*)(const char*, const char*)>("link")(path.c_str(), aside.c_str()) == 0) name.old = aside;
        names.push_back(name);
    }
    /// After a rename: the unsynced file has another path.
    void moved(const std::string& from, const std::string& to)
    {
        const std::lock_guard lock(mutex);
        for (auto& [file, path] : unsynced)
            if (path == from) path = to;
    }
};

Injector& injector()
{
    static Injector the;
    return the;
}

std::string absolute(const char* path)
{
    if (path[0] == '/') return path;
    char folder[4096];
    return getcwd(folder, sizeof folder) ? std::string(folder) + "/" + path : path;
}

int openAs(const char* name, const char* path, int flags, mode_t mode)
{
    const bool writes = (flags & (O_WRONLY | O_RDWR | O_CREAT)) != 0;
    if (writes && injector().fails(absolute(path))) return -1;
    return next<int (*)(const char*, int, ...)>(name)(path, flags, mode);
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...)
{
    va_list rest;
    va_start(rest, flags);
    const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(rest, mode_t) : 0;
    va_end(rest);
    return openAs("open", path, flags, mode);
}

int open64(const char* path, int flags, ...)
{
    va_list rest;
    va_start(rest, flags);
    const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(rest, mode_t) : 0;
    va_end(rest);
    return openAs("open64", path, flags, mode);
}

ssize_t write(int fd, const void* data, size_t size)
{
    if (injector().fails(Injector::pathOf(fd))) {
        // Half of it arrives, as on a disk that is full in the middle.
        if (size > 1) (void)!next<ssize_t (*)(int, const void*, size_t)>("write")(fd, data, size / 2);
        errno = injector().code;
        return -1;
    }
    const ssize_t n = next<ssize_t (*)(int, const void*, size_t)>("write")(fd, data, size);
    if (n > 0) injector().written(fd);
    return n;
}

ssize_t pwrite(int fd, const void* data, size_t size, off_t at)
{
    if (injector().fails(Injector::pathOf(fd))) return -1;
    return next<ssize_t (*)(int, const void*, size_t, off_t)>("pwrite")(fd, data, size, at);
}

ssize_t sendfile(int to, int from, off_t* at, size_t size)
{
    if (injector().fails(Injector::pathOf(to))) return -1;
    injector().written(to);
    return next<ssize_t (*)(int, int, off_t*, size_t)>("sendfile")(to, from, at, size);
}

ssize_t copy_file_range(int from, off_t* fromAt, int to, off_t* toAt, size_t size, unsigned flags)
{
    if (injector().fails(Injector::pathOf(to))) return -1;
    injector().written(to);
    return next<ssize_t (*)(int, off_t*, int, off_t*, size_t, unsigned)>("copy_file_range")(from, fromAt, to, toAt,
                                                                                            size, flags);
}

int fsync(int fd)
{
    if (injector().fails(Injector::pathOf(fd))) return -1;
    injector().synced(fd);
    return 0;  // the tests need no real disk
}

int fdatasync(int fd)
{
    if (injector().fails(Injector::pathOf(fd))) return -1;
    injector().synced(fd);
    return 0;
}

int ftruncate(int fd, off_t size)
{
    if (injector().fails(Injector::pathOf(fd))) return -1;
    return next<int (*)(int, off_t)>("ftruncate")(fd, size);
}

int close(int fd)
{
    const std::string path = Injector::pathOf(fd);
    const bool fails = injector().fails(path);
    const int code = errno;
    const int result = next<int (*)(int)>("close")(fd);
    if (!fails) return result;
    errno = code;
    return -1;
}

int rename(const char* from, const char* to)
{
    const std::string source = absolute(from), target = absolute(to);
    if (injector().fails(target)) return -1;
    if (injector().concerns(target)) injector().nameChanges(target);
    const int result = next<int (*)(const char*, const char*)>("rename")(from, to);
    if (result == 0) injector().moved(source, target);
    return result;
}

int link(const char* from, const char* to)
{
    if (injector().fails(absolute(to))) return -1;
    return next<int (*)(const char*, const char*)>("link")(from, to);
}

int unlink(const char* path)
{
    const std::string target = absolute(path);
    if (injector().fails(target)) return -1;
    if (injector().concerns(target)) injector().nameChanges(target);
    return next<int (*)(const char*)>("unlink")(path);
}

int mkdir(const char* path, mode_t mode)
{
    if (injector().fails(absolute(path))) return -1;
    return next<int (*)(const char*, mode_t)>("mkdir")(path, mode);
}

}  // extern "C"
