// PluginWatcher: tells when a plugin in a watched folder was rebuilt and its files are whole.
#pragma once

#include <QFileSystemWatcher>
#include <QObject>
#include <QTimer>

#include <filesystem>
#include <map>
#include <vector>

namespace jet::host {

class PluginWatcher final : public QObject {
    Q_OBJECT

public:
    /// Each folder is that of one plugin, or one of plugin folders.
    explicit PluginWatcher(std::vector<std::filesystem::path> folders, QObject* parent = nullptr);

    /// Is the library there to its end? A linker writes it in pieces.
    static bool isWhole(const std::filesystem::path& library);

signals:
    /// Manifest or library changed, or the plugin is new, and nothing was written for a moment.
    void changed(const QString& folder);

private:
    /// Time and size of the files that make a plugin; equal ones: nothing happened.
    using Print = std::vector<std::pair<std::filesystem::path, std::pair<std::int64_t, std::uintmax_t>>>;

    std::vector<std::filesystem::path> pluginFolders() const;
    static Print printOf(const std::filesystem::path& folder);
    void look();
    void watchAll();

    std::vector<std::filesystem::path> folders_;
    QFileSystemWatcher watcher_;
    QTimer settle_;
    std::map<std::filesystem::path, Print> known_, seen_;
};

}  // namespace jet::host
