// The shared library of a plugin: opened through Boost.DLL, its C entry checked before any C++ of it is called.
#pragma once

#include "plugin.hpp"

#include <boost/dll/shared_library.hpp>

namespace jet::host {

class PluginLibrary {
public:
    /// Opens, checks the entry and collects the registrations. The manifest was checked before (see checkBuild).
    static Result<std::unique_ptr<PluginLibrary>> open(const Plugin& plugin, Registrations& registrations);

private:
    boost::dll::shared_library library_;
};

/// Can this host run what the manifest says it was built for? Asked before the library is opened, since static
/// constructors run inside dlopen.
Result<void> checkBuild(const Manifest& manifest);
/// Was registered what is declared? The error lists the difference.
Result<void> checkRegistrations(const Manifest& manifest, const Registrations& registrations);

}  // namespace jet::host
