// Where a repository lies: a folder, a file:// address, or an http(s):// address that the system's curl reads.
#pragma once

#include <jet/result.hpp>

#include <chrono>
#include <filesystem>
#include <string>
#include <string_view>

namespace jet::host {

class Source {
public:
    /// "/srv/plugins", "file:///srv/plugins", "https://plugins.acme.org/jet".
    static Result<Source> parse(const std::string& where);

    /// The file of that name in the repository (as checkEntryName() allows), at most `most` bytes. Without a shell;
    /// redirections stay with http(s), and with https where it began so.
    Result<std::string> read(std::string_view name, std::size_t most) const;
    /// The file's address, for messages.
    std::string address(std::string_view name) const;

    std::chrono::seconds timeLimit{300};  ///< for one file
    std::chrono::seconds connectLimit{15};

private:
    Result<std::string> readFolder(std::string_view name, std::size_t most) const;
    Result<std::string> download(std::string_view name, std::size_t most) const;

    std::filesystem::path folder_;  // empty: the address is used
    std::string address_;
};

}  // namespace jet::host
