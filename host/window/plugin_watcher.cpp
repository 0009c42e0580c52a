#include "window/plugin_watcher.hpp"

#include <QStringList>

#include <algorithm>
#include <elf.h>
#include <fstream>

namespace jet::host {

namespace fs = std::filesystem;

namespace {

constexpr int kSettleMs = 100;  // a build writes library and manifest shortly after each other

QString toQt(const fs::path& path) { return QString::fromStdString(path.string()); }

}  // namespace

PluginWatcher::PluginWatcher(std::vector<fs::path> folders, QObject* parent)
    : QObject(parent), folders_(std::move(folders))
{
    settle_.setSingleShot(true);
    connect(&settle_, &QTimer::timeout, this, &PluginWatcher::look);
    const auto later = [this] { settle_.start(kSettleMs); };
    connect(&watcher_, &QFileSystemWatcher::directoryChanged, this, later);
    connect(&watcher_, &QFileSystemWatcher::fileChanged, this, later);
    for (const fs::path& folder : pluginFolders()) known_[folder] = printOf(folder);
    seen_ = known_;
    watchAll();
}

std::vector<fs::path> PluginWatcher::pluginFolders() const
{
    std::vector<fs::path> all;
    std::error_code problem;
    for (const fs::path& folder : folders_) {
        if (fs::exists(folder / "plugin.json", problem)) all.push_back(folder);
        for (const auto& entry : fs::directory_iterator(folder, problem))
            if (fs::exists(entry.path() / "plugin.json", problem)) all.push_back(entry.path());
    }
    return all;
}

PluginWatcher::Print PluginWatcher::printOf(const fs::path& folder)
{
    Print print;
    std::error_code problem;
    for (const auto& entry : fs::directory_iterator(folder, problem)) {
        const fs::path& file = entry.path();
        if (file.filename() != "plugin.json" && file.extension() != ".so") continue;
        const auto time = fs::last_write_time(file, problem);
        print.push_back({file, {time.time_since_epoch().count(), fs::file_size(file, problem)}});
    }
    std::sort(print.begin(), print.end());
    return print;
}

bool PluginWatcher::isWhole(const fs::path& library)
{
    // The table of sections is what a linker puts last.
    std::error_code problem;
    const std::uintmax_t size = fs::file_size(library, problem);
    Elf64_Ehdr header{};
    std::ifstream in(library, std::ios::binary);
    if (problem || !in.read(reinterpret_cast<char*>(&header), sizeof header)) return false;
    if (!std::equal(header.e_ident, header.e_ident + SELFMAG, ELFMAG)) return false;
    return header.e_shoff + std::uintmax_t{header.e_shnum} * header.e_shentsize <= size;
}

void PluginWatcher::look()
{
    bool again = false;
    for (const fs::path& folder : pluginFolders()) {
        Print print = printOf(folder);
        if (print == known_[folder]) continue;
        const bool quiet = print == seen_[folder];
        const bool whole = std::all_of(print.begin(), print.end(), [](const auto& file) {
            return file.first.extension() != ".so" || isWhole(file.first);
        });
        const bool complete =
            std::any_of(print.begin(), print.end(), [](const auto& file) { return file.first.extension() == ".so"; });
        seen_[folder] = print;
        if (!quiet || !whole || !complete) {
            again = true;
            continue;
        }
        known_[folder] = std::move(print);
        emit changed(toQt(folder));
    }
    watchAll();
    if (again) settle_.start(kSettleMs);
}

// A file that was replaced is not watched any more: its path is added again.
void PluginWatcher::watchAll()
{
    QStringList wanted;
    for (const fs::path& folder : folders_) wanted << toQt(folder);
    for (const fs::path& folder : pluginFolders()) {
        wanted << toQt(folder);
        for (const auto& file : printOf(folder)) wanted << toQt(file.first);
    }
    const QStringList watched = watcher_.files() + watcher_.directories();
    wanted.removeIf([&](const QString& path) { return watched.contains(path); });
    if (!wanted.isEmpty()) watcher_.addPaths(wanted);
}

}  // namespace jet::host
