#include "source.hpp"

#include "host/archive/entry_name.hpp"
#include "host/process/child_process.hpp"

#include <jet/format.hpp>

namespace jet::host {

namespace fs = std::filesystem;

namespace {

// Names are printable ASCII; what has a meaning in an address is written as %XX.
std::string percentEncoded(std::string_view name)
{
    std::string text;
    for (const char c : name) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                           std::string_view("-._~/").find(c) != std::string_view::npos;
        if (plain) {
            text += c;
            continue;
        }
        text += '%';
        text += "0123456789ABCDEF"[static_cast<unsigned char>(c) >> 4];
        text += "0123456789ABCDEF"[static_cast<unsigned char>(c) & 15];
    }
    return text;
}

int digit(char c)
{
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

std::string percentDecoded(std::string_view text)
{
    std::string plain;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool code = text[i] == '%' && i + 2 < text.size() && digit(text[i + 1]) >= 0 && digit(text[i + 2]) >= 0;
        if (!code) {
            plain += text[i];
            continue;
        }
        plain += static_cast<char>(digit(text[i + 1]) * 16 + digit(text[i + 2]));
        i += 2;
    }
    return plain;
}

// The exit codes of curl that a user can do something about (man curl, EXIT CODES).
std::string curlProblem(int code, const std::string& said)
{
    switch (code) {
    case 3: return "the address is not valid; check it";
    case 6: return "there is no such host; check the address and the network";
    case 7: return "the host does not answer; check the address and the network";
    case 18: return "the download broke off; try again";
    case 22: return "the server has no such file; check the address" + (said.empty() ? "" : " (" + said + ")");
    case 28: return "it took too long; try again later";
    case 35:
    case 51:
    case 60: return "the server's certificate is not trusted (" + said + ")";
    case 47: return "it leads from one place to the next without end; check the address";
    case 52: return "the server answered nothing; try again later";
    case 56: return "the connection broke; try again";
    case 63: return "it is larger than allowed";
    default: return said.empty() ? "curl ended with exit code " + std::to_string(code) : said;
    }
}

std::string firstLine(std::string text)
{
    text.erase(std::min(text.find('\n'), text.size()));
    return text;
}

}  // namespace

Result<Source> Source::parse(const std::string& where)
{
    Source source;
    source.address_ = where;
    while (source.address_.size() > 1 && source.address_.ends_with('/')) source.address_.pop_back();
    const std::size_t scheme = where.find("://");
    if (scheme == std::string::npos) {
        source.folder_ = where;
    } else if (where.starts_with("file://")) {
        const std::string path = where.substr(7);
        if (!path.starts_with('/'))
            return Error("'" + where + "' is no address of a folder here; write it as file:///FOLDER");
        source.folder_ = percentDecoded(path);
    } else if (!where.starts_with("http://") && !where.starts_with("https://")) {
        return Error("'" + where +
                     "' is no repository; give a folder, or an address that begins with file://, http:// or https://");
    }
    std::error_code ignored;
    if (!source.folder_.empty() && !fs::is_directory(source.folder_, ignored))
        return Error("there is no such folder; a repository is a folder with an index.json",
                     Location{source.folder_.string(), 0, 0});
    if (source.folder_.empty() && where.find_first_of(" \t\r\n\"<>\\^`{|}") != std::string::npos)
        return Error("'" + where + "' is not an address: it has a character that addresses do not have");
    return source;
}

std::string Source::address(std::string_view name) const
{
    if (!folder_.empty()) return (folder_ / name).string();
    return address_ + "/" + percentEncoded(name);
}

Result<std::string> Source::read(std::string_view name, std::size_t most) const
{
    if (const auto fine = checkEntryName(name); !fine)
        return Error("the repository names a file " + shownName(name) + ", but " + fine.error().message +
                         "; it is refused",
                     Location{address_, 0, 0});
    return folder_.empty() ? download(name, most) : readFolder(name, most);
}

Result<std::string> Source::readFolder(std::string_view name, std::size_t most) const
{
    const fs::path file = folder_ / name;
    std::error_code ignored;
    if (!fs::exists(file, ignored)) return Error("the repository has no such file", Location{file.string(), 0, 0});
    if (!fs::is_regular_file(file, ignored)) return Error("is not a file", Location{file.string(), 0, 0});
    if (fs::file_size(file, ignored) > most)
        return Error("is larger than " + std::to_string(most >> 20) + " MB; it is refused",
                     Location{file.string(), 0, 0});
    return readFile(file);
}

Result<std::string> Source::download(std::string_view name, std::size_t most) const
{
    const std::string file = address(name);
    if (findProgram("curl").empty())
        return Error(
            "to read a repository on the network, the program curl is needed, and it is not installed; install "
            "it, or copy the repository to a folder",
            Location{file, 0, 0});
    const bool safe = address_.starts_with("https://");
    ChildOptions child;
    child.limits.time = timeLimit + std::chrono::seconds(5);  // curl itself gives up first, and says why
    child.limits.output = most;
    const auto run = runChild({"curl",
                               "-q",
                               "--silent",
                               "--show-error",
                               "--fail",
                               "--location",
                               "--globoff",
                               "--proto",
                               safe ? "=https" : "=http,https",
                               "--proto-redir",
                               safe ? "=https" : "=http,https",
                               "--max-redirs",
                               "5",
                               "--connect-timeout",
                               std::to_string(connectLimit.count()),
                               "--max-time",
                               std::to_string(timeLimit.count()),
                               "--max-filesize",
                               std::to_string(most),
                               "--output",
                               "-",
                               "--url",
                               file},
                              child);
    if (!run) return run.error();
    if (run->fine()) return run->out;
    std::string problem;
    if (run->tooMuchOutput)
        problem = curlProblem(63, "");
    else if (!run->endedByItself())
        problem = "the download failed: " + run->reason(child.limits);
    else
        problem = curlProblem(run->code, firstLine(run->err));
    return Error("cannot be downloaded: " + problem, Location{file, 0, 0});
}

}  // namespace jet::host
