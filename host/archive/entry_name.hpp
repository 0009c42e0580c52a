// Names of files in a package: what may be unpacked anywhere without surprise.
#pragma once

#include <jet/result.hpp>

#include <map>
#include <string>
#include <string_view>

namespace jet::host {

/// May this be the relative name of a file in a package or repository? Parts of printable ASCII joined by '/', none of
/// them empty, "." or "..", no '\' and ':', of bounded length; with `unicode` also characters beyond ASCII, in UTF-8.
/// The error says what is wrong, without the name.
Result<void> checkEntryName(std::string_view name, bool unicode = false);

/// The name as a message shows it: quoted, control characters and bytes beyond ASCII as \xNN, shortened.
std::string shownName(std::string_view name);

/// Tells names that would meet in one file on some file system: equal ones, ones that differ in case only, and a file
/// where another entry needs a folder.
class EntryNames {
public:
    /// `folder`: the entry is a folder itself.
    Result<void> add(std::string_view name, bool folder);

private:
    struct Place {
        std::string name;
        bool folder;
    };
    Result<void> addPart(const std::string& name, bool folder, bool implied);
    std::map<std::string, Place, std::less<>> places_;  // by lower-case name
};

}  // namespace jet::host
