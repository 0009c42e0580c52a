// ProjectLock: one editor at a time writes a project.
#pragma once

#include <jet/result.hpp>

#include <filesystem>

namespace jet {

/// Held while its file, `.project.jet.lock` beside the project's, is locked by this process (flock) and names it. The
/// lock goes with the process, so one that a crash left behind is no obstacle: it is taken over. [any thread]
class JET_API ProjectLock {
public:
    ProjectLock() = default;
    ProjectLock(ProjectLock&& other) noexcept;
    ProjectLock& operator=(ProjectLock&& other) noexcept;
    ~ProjectLock();

    /// The Error says who has it: process, machine, since when. Where nobody can write - a folder that is read-only or
    /// not there - it succeeds without holding anything.
    static Result<ProjectLock> take(const std::filesystem::path& projectFile);
    bool isHeld() const { return fd_ >= 0; }
    void release();

private:
    int fd_ = -1;
    std::filesystem::path file_;
};

}  // namespace jet
