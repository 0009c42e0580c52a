// The shared library of a plugin: opened through Boost.DLL, its C entry checked before any C++ of it is called.
#pragma once

#include "plugin.hpp"

#include <boost/dll/shared_library.hpp>

namespace jet::host {

struct LibraryOptions {
    /// Loads a copy from a fresh path, so that the file may be rebuilt and loaded again: what has the path of a loaded
    /// library is taken for that one, and what is written over a mapped file changes running code.
    bool copy = false;
    /// Unloads it with this object. Otherwise the mapping stays until the program ends: exceptions, queued calls and
    /// types of the plugin may outlive any use of it.
    bool unload = false;
};

class PluginLibrary {
public:
    /// Opens <folder>/<manifest.library>.so, checks the entry and collects the registrations. The manifest was checked
    /// before (see checkBuild).
    static Result<std::unique_ptr<PluginLibrary>> open(const std::filesystem::path& folder, const Manifest& manifest,
                                                       CallAccount& account, LibraryOptions options,
                                                       Registrations& registrations);

    /// The file it was mapped from.
    const std::filesystem::path& file() const { return file_; }
    /// It stays in memory after this object is gone.
    void keep() const;
    /// Lets the system take back the memory of code that is not going to run any more. It comes back if it does.
    void release() const;

private:
    boost::dll::shared_library library_;
    std::filesystem::path file_;
    const void* entry_ = nullptr;
};

/// Can this host run what the manifest says it was built for? Asked before the library is opened, since static
/// constructors run inside dlopen.
Result<void> checkBuild(const Manifest& manifest);
/// Was registered what is declared? The error lists the difference.
Result<void> checkRegistrations(const Manifest& manifest, const Registrations& registrations);

}  // namespace jet::host
