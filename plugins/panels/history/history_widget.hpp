// HistoryWidget: the steps of a scene, or of the project, as a list; a click, or Enter on the row the arrow keys went
// to, goes to the state after that step. The saved state is marked, undone steps are pale, the present state is bold.
//
// It shows the history that Undo works on: the front scene's, or that of the panel with the keyboard focus
// (jet/ui/history_focus.hpp). Its tabs choose the other one, and take the focus, so that this holds for them, too.
#pragma once

#include "history_model.hpp"

#include <jet/editor.hpp>
#include <jet/ui/history_focus.hpp>

#include <QLabel>
#include <QListView>
#include <QTabBar>
#include <QWidget>

namespace jet::history {

class HistoryWidget final : public QWidget {
public:
    explicit HistoryWidget(Editor& editor);

    QTabBar* tabs() const { return tabs_; }
    QListView* list() const { return list_; }
    /// What the next Undo takes back.
    QLabel* next() const { return next_; }
    QLabel* memory() const { return memory_; }

private:
    /// Shows what Undo works on.
    void follow();
    void followSoon();
    void choose(int tab);
    /// Another scene or project is in front.
    void frontChanged();
    void work(ui::HistoryFocus history);
    void showNext(bool isProject);
    bool isPresent(const Scene* scene) const;
    void refresh();
    void goTo(const QModelIndex& index);

    Editor& editor_;
    HistoryModel model_;
    QTabBar* tabs_;
    QListView* list_;
    QLabel* next_;
    QLabel* memory_;
    std::vector<Subscription> subscriptions_;
    Subscription changed_;
    bool follows_ = false, otherFront_ = false;
    ui::HistoryFocusWatch focus_;
};

}  // namespace jet::history
