#include "project_check.hpp"

#include "project_mender.hpp"
#include "schema.hpp"
#include "setting_place.hpp"

#include <jet/catalog.hpp>
#include <jet/format.hpp>

#include <algorithm>
#include <optional>

namespace jet::host {

namespace fs = std::filesystem;

bool CheckReport::isFine() const
{
    return project && std::ranges::none_of(findings, [](const Finding& finding) {
               return finding.weight == Finding::Weight::Error && !finding.repaired;
           });
}

namespace {

bool isTold(const Findings& findings, const std::string& file)
{
    return std::ranges::any_of(
        findings, [&](const Finding& f) { return f.where.file == file && f.weight == Finding::Weight::Error; });
}

// A file with findings of its own needs no second opinion, in the words of a library.
Result<void> addSchemaFindings(CheckReport& report, const ProjectMender& mender, const fs::path& schemas)
{
    const std::string project = report.file.filename().string();
    for (const auto& [name, text] : mender.originals()) {
        const fs::path file = report.file.parent_path() / name;
        if (!mender.isCurrent(name) || isTold(report.findings, file.string())) continue;
        auto found = checkAgainstSchema(text, file.string(), schemas / (name == project ? "project.rng" : "scene.rng"));
        if (!found) return found.error();
        std::ranges::move(*found, std::back_inserter(report.findings));
    }
    return {};
}

/// All of them, or none: what was replaced is put back when a later one cannot be written.
Result<void> writeAll(const fs::path& folder, const std::vector<std::pair<std::string, std::string>>& files)
{
    std::vector<std::pair<fs::path, std::optional<std::string>>> replaced;
    for (const auto& [name, text] : files) {
        std::error_code ignored;
        auto before = readFile(folder / name);
        replaced.emplace_back(folder / name, before ? std::optional(std::move(*before)) : std::nullopt);
        fs::create_directories((folder / name).parent_path(), ignored);
        const auto written = writeFileAtomically(folder / name, text);
        if (written) continue;
        for (const auto& [file, content] : replaced) {
            if (content) {
                (void)writeFileAtomically(file, *content);
            } else {
                fs::remove(file, ignored);
            }
        }
        return written;
    }
    return {};
}

Result<void> writeRepair(CheckReport& report, const ProjectMender& mender)
{
    const auto changed = mender.changedFiles();
    if (!changed.empty() && fs::exists(report.file))
        if (const auto kept = backUpProject(report.file); !kept) return kept;
    if (const auto written = writeAll(report.file.parent_path(), changed); !written) return written;
    for (const auto& [name, text] : changed) report.written.push_back(report.file.parent_path() / name);
    for (const fs::path& file : mender.leftovers()) {
        std::error_code ignored;
        fs::remove_all(file, ignored);
    }
    for (Finding& finding : report.findings) finding.repaired = !finding.repair.empty();
    return {};
}

}  // namespace

namespace {

/// A scene that names an engine nobody has does not play.
void addEngineFindings(CheckReport& report, const Catalog& catalog)
{
    const auto engines = catalog.contributions(ContributionKind::PhysicsEngine);
    for (const Scene* scene : report.project->scenes()) {
        const auto wanted = scene->setting("physics").as<std::string>();
        if (wanted.empty() || std::ranges::any_of(engines, [&](const Contribution& one) { return one.id == wanted; }))
            continue;
        report.findings.push_back(
            {Finding::Weight::Error, placeOfSetting(report.file, scene->name(), "physics"),
             "the scene cannot be played: " + catalog.explain(ContributionKind::PhysicsEngine, wanted), "", false});
    }
}

}  // namespace

Result<CheckReport> checkProjectFiles(const fs::path& path, EventsCenter& events, Catalog& catalog,
                                      const CheckOptions& options)
{
    auto file = findProjectFile(path);
    if (!file) {
        // A folder that lost its project.jet may have it among its backups.
        std::error_code ignored;
        if (!fs::is_directory(path, ignored) || findBackups(path / "project.jet").empty()) return file.error();
        file = path / "project.jet";
    }
    CheckReport report;
    report.file = *file;
    ProjectMender mender(*file, events, catalog);
    if (const auto read = mender.run(); !read) return read.error();
    report.findings = mender.findings();
    if (!options.schemas.empty())
        if (const auto told = addSchemaFindings(report, mender, options.schemas); !told) return told.error();
    if (options.repair && mender.opens())
        if (const auto written = writeRepair(report, mender); !written) return written.error();
    auto opened = Project::load(*file, events, catalog);
    if (opened) {
        report.project = std::move(*opened);
        addEngineFindings(report, catalog);
        return report;
    }
    report.problem = opened.error();
    const Location& where = report.problem.where;
    if (!isTold(report.findings, where.file))
        report.findings.push_back({Finding::Weight::Error, where, report.problem.message, "", false});
    return report;
}

}  // namespace jet::host
