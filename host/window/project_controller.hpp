// ProjectController: the open project and its file: new, open, save, recent, and asking before changes are lost.
#pragma once

#include "window/actions.hpp"
#include "window/documents.hpp"

#include <filesystem>
#include <functional>

class QSettings;

namespace jet::host {

class ProjectController final : public QObject {
    Q_OBJECT

public:
    enum class Answer { Save, Discard, Cancel };

    ProjectController(Editor& editor, Documents& documents, QWidget* window);
    ~ProjectController() override;

    std::vector<ActionSpec> actions();
    void fillRecentMenu(QMenu& menu);

    Project& project() const { return *project_; }
    /// A new, untitled project.
    void create();
    /// False, and the present project stays, when it cannot be read; the message bar says why.
    bool open(const std::filesystem::path& path);
    bool save();
    bool saveAs(const std::filesystem::path& folder);
    /// Asks about unsaved changes, if any; false: the user wants to stay.
    bool mayClose();
    bool isModified() const;
    /// Closes all tabs; before the window goes.
    void close();

    void restoreRecent(QSettings& settings);
    void saveRecent(QSettings& settings) const;
    /// Replaces the question box, for tests.
    void setQuestion(std::function<Answer()> question) { question_ = std::move(question); }
    /// Called with the path before a project is read.
    void setBeforeOpen(std::function<void(const std::filesystem::path&)> before) { beforeOpen_ = std::move(before); }
    /// Tells which plugins the opened project misses; false when it misses none.
    void setTellMissing(std::function<bool()> tell) { tellMissing_ = std::move(tell); }

signals:
    void saved();

private:
    void install(std::unique_ptr<Project> project);
    void askAndCreate();
    void askAndOpen();
    void askAndOpen(const QString& path);
    bool askAndSaveAs();
    bool finishSave(const Result<void>& result);
    void remember(const std::filesystem::path& file);
    Answer ask();

    Editor& editor_;
    Documents& documents_;
    QWidget* window_;
    std::unique_ptr<Project> project_;
    QStringList recent_;
    std::function<Answer()> question_;
    std::function<void(const std::filesystem::path&)> beforeOpen_;
    std::function<bool()> tellMissing_;
};

}  // namespace jet::host
