#include "project_trust.hpp"

#include "user_choice.hpp"

#include <jet/format.hpp>

#include <nettle/sha2.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>

namespace jet::host {

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

class Sha256 {
public:
    Sha256() { sha256_init(&state_); }
    void add(std::string_view bytes)
    {
        sha256_update(&state_, bytes.size(), reinterpret_cast<const std::uint8_t*>(bytes.data()));
    }
    /// A text with its length, so that no two lists of texts give the same bytes.
    void addText(const std::string& text) { add(std::to_string(text.size()) + ":" + text); }
    std::string hex()
    {
        std::uint8_t bytes[SHA256_DIGEST_SIZE];
        sha256_digest(&state_, sizeof bytes, bytes);
        std::string text;
        for (const std::uint8_t byte : bytes) {
            text += "0123456789abcdef"[byte >> 4U];
            text += "0123456789abcdef"[byte & 15U];
        }
        return text;
    }

private:
    sha256_ctx state_{};
};

bool addFile(Sha256& sum, const fs::path& file)
{
    std::ifstream in(file, std::ios::binary);
    std::vector<char> block(1 << 16);
    while (in) {
        in.read(block.data(), static_cast<std::streamsize>(block.size()));
        sum.add({block.data(), static_cast<std::size_t>(in.gcount())});
    }
    return in.eof();
}

/// Over names and contents of all files. Empty when something cannot be read, or where a link leads elsewhere: what
/// lies there could change unseen.
std::string fingerprintOf(const fs::path& folder)
{
    std::error_code problem;
    std::vector<fs::path> paths;
    for (auto entry = fs::recursive_directory_iterator(folder, problem); !problem && entry != fs::end(entry);
         entry.increment(problem))
        paths.push_back(entry->path());
    if (problem) return {};
    std::sort(paths.begin(), paths.end());
    Sha256 sum;
    for (const fs::path& path : paths) {
        const fs::file_status status = fs::symlink_status(path, problem);
        if (fs::is_directory(status)) continue;
        if (!fs::is_regular_file(status)) return {};
        sum.addText(path.lexically_relative(folder).generic_string());
        sum.addText(std::to_string(fs::file_size(path, problem)));
        if (problem || !addFile(sum, path)) return {};
    }
    return sum.hex();
}

fs::path trustFile() { return userConfigFolder() / "trusted-projects.json"; }

Result<Json> readTrust()
{
    std::error_code ignored;
    if (!fs::exists(trustFile(), ignored)) return Json::object();
    const auto text = readFile(trustFile());
    if (!text) return text.error();
    Json json = Json::parse(*text, nullptr, false);
    if (json.is_object()) return json;
    return Error("the list of trusted projects is not a JSON object; mend or delete the file",
                 Location{trustFile().string(), 1, 1});
}

}  // namespace

std::string ProjectPlugins::advice() const
{
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
    const std::string what = "the project brings plugins of its own (" + list + "), which were left out: ";
    if (fingerprint.empty())
        return what + "the folder " + folder.string() +
               " holds links or files that cannot be read; put the files themselves there";
    return what +
           (trust == Trust::Changed ? "they changed since you trusted this project"
                                    : "this project is not trusted yet") +
           "; if you know where it comes from, run 'jet plugins trust " + project.string() + "'";
}

std::optional<ProjectPlugins> findProjectPlugins(const fs::path& project)
{
    std::error_code problem;
    const fs::path real = fs::canonical(project, problem);
    if (problem) return std::nullopt;
    ProjectPlugins found;
    found.project = fs::is_directory(real, problem) ? real : real.parent_path();
    found.folder = found.project / "plugins";
    for (const auto& entry : fs::directory_iterator(found.folder, problem))
        if (fs::exists(entry.path() / "plugin.json", problem)) found.names.push_back(entry.path().filename().string());
    if (found.names.empty()) return std::nullopt;
    std::sort(found.names.begin(), found.names.end());
    found.fingerprint = fingerprintOf(found.folder);
    const auto known = readTrust();
    if (!known || !known->contains(found.project.string())) return found;
    const bool same = !found.fingerprint.empty() && (*known)[found.project.string()] == found.fingerprint;
    found.trust = same ? ProjectPlugins::Trust::Trusted : ProjectPlugins::Trust::Changed;
    return found;
}

Result<void> trustProject(const ProjectPlugins& plugins, bool trusted)
{
    if (trusted && plugins.fingerprint.empty()) return Error(plugins.advice());
    auto known = readTrust();
    if (!known) return known.error();
    if (trusted) {
        (*known)[plugins.project.string()] = plugins.fingerprint;
    } else {
        known->erase(plugins.project.string());
    }
    std::error_code ignored;
    fs::create_directories(userConfigFolder(), ignored);
    return writeFileAtomically(trustFile(), known->dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace jet::host
