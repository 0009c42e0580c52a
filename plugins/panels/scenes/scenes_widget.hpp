// ScenesWidget: what can be done with a project's scenes, scripts and files, by buttons, menu and keyboard. All of it
// goes through the project's tree or a scene's transactions, so Undo takes it back.
#pragma once

#include "project_rows.hpp"

#include <jet/project_tree.hpp>
#include <jet/ui/command_bar.hpp>

#include <QTimer>
#include <QWidget>

#include <functional>
#include <span>

namespace jet::scenes {

class ScenesWidget final : public QWidget {
    Q_OBJECT

public:
    explicit ScenesWidget(Editor& editor);

    ProjectRows& rows() { return *rows_; }
    /// Replaces the dialog that asks for files, for tests.
    void setFileQuestion(std::function<QStringList()> question) { askFiles_ = std::move(question); }
    /// Replaces the question whether removed files shall go for good, for tests.
    void setEmptyQuestion(std::function<bool(const QString&)> question) { askEmpty_ = std::move(question); }

protected:
    void showEvent(QShowEvent* event) override;

private:
    struct Command {
        const char* icon;
        const char* text;
        void (ScenesWidget::*run)(const Row& row);
        bool (*fits)(const Row& row);
        const char* key;  ///< while the tree has the focus; empty: none
        bool onBar;
    };
    static std::span<const Command> commands();

    ui::CommandBar* makeBar();
    void run(const Command& command);
    /// Runs what changes the project, and tells the user why it could not be done.
    void attempt(const std::function<void()>& change);
    void follow();
    void rebuildSoon() { soon_.start(0); }
    void rebuildNow();
    Row currentRow() const;
    /// Undo goes to the history of what was done last in this panel.
    void aim(Scene* scene);

    void open(const Row& row);
    void addScene(const Row& row);
    void addFilter(const Row& row);
    void addScript(const Row& row);
    void addFiles(const Row& row);
    void rename(const Row& row);
    void duplicate(const Row& row);
    void remove(const Row& row);
    void makeStart(const Row& row);
    void emptyRemoved(const Row& row);
    void up(const Row& row) { shift(row, -1); }
    void down(const Row& row) { shift(row, 1); }
    void shift(const Row& row, int by);
    void giveName(const Row& row, const std::string& name);
    void move(const Row& row, Filter& filter, int index);
    void takeFiles(const QStringList& files);

    Editor& editor_;
    ProjectRows* rows_;
    QTimer soon_;
    std::function<QStringList()> askFiles_;
    std::function<bool(const QString&)> askEmpty_;
    std::vector<Subscription> subscriptions_;
};

}  // namespace jet::scenes
