#include "system_error.hpp"

#include <jet/project_lock.hpp>

#include <cerrno>
#include <ctime>
#include <fcntl.h>
#include <string>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace jet {

namespace fs = std::filesystem;

namespace {

std::string thisProcess()
{
    char host[256] = "unknown";
    ::gethostname(host, sizeof host - 1);
    char time[32];
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    ::gmtime_r(&now, &utc);
    std::strftime(time, sizeof time, "%Y-%m-%d %H:%M:%S", &utc);
    return "process " + std::to_string(::getpid()) + " on " + host + " since " + time + " UTC\n";
}

std::string holderOf(int fd)
{
    char text[512];
    const ssize_t n = ::pread(fd, text, sizeof text, 0);
    std::string holder(text, n > 0 ? static_cast<std::size_t>(n) : 0);
    holder.erase(std::min(holder.find('\n'), holder.size()));
    return holder.empty() ? "another process" : holder;
}

/// Was the file we locked removed or replaced before we had the lock?
bool isStill(const fs::path& file, int fd)
{
    struct stat ours {
    }, present{};
    return ::fstat(fd, &ours) == 0 && ::stat(file.c_str(), &present) == 0 && ours.st_ino == present.st_ino &&
           ours.st_dev == present.st_dev;
}

}  // namespace

ProjectLock::ProjectLock(ProjectLock&& other) noexcept
    : fd_(std::exchange(other.fd_, -1)), file_(std::move(other.file_))
{
}

ProjectLock& ProjectLock::operator=(ProjectLock&& other) noexcept
{
    if (this == &other) return *this;
    release();
    fd_ = std::exchange(other.fd_, -1);
    file_ = std::move(other.file_);
    return *this;
}

ProjectLock::~ProjectLock() { release(); }

void ProjectLock::release()
{
    if (fd_ < 0) return;
    ::unlink(file_.c_str());  // before the lock goes: nobody else can have it now
    ::close(std::exchange(fd_, -1));
}

Result<ProjectLock> ProjectLock::take(const fs::path& projectFile)
{
    ProjectLock lock;
    std::error_code ignored;
    const fs::path project = fs::weakly_canonical(fs::absolute(projectFile, ignored), ignored);
    lock.file_ = project.parent_path() / ("." + project.filename().string() + ".lock");
    for (int attempt = 0; attempt < 100; ++attempt) {
        const int fd = ::open(lock.file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
        if (fd < 0) return lock;  // what cannot be written needs no lock
        if (::flock(fd, LOCK_EX | LOCK_NB) != 0) {
            const int code = errno;
            const std::string holder = holderOf(fd);
            ::close(fd);
            if (code != EWOULDBLOCK) return lock;  // a file system without locks
            return Error("this project is open in another editor (" + holder +
                             "); close it there, or save under another name here",
                         Location{projectFile.string(), 0, 0});
        }
        if (!isStill(lock.file_, fd)) {
            ::close(fd);
            continue;
        }
        const std::string text = thisProcess();
        if (::ftruncate(fd, 0) == 0) (void)!::pwrite(fd, text.data(), text.size(), 0);
        lock.fd_ = fd;
        return lock;
    }
    return lock;
}

}  // namespace jet
