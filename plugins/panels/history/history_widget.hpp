// HistoryWidget: the steps of the front scene as a list; a click, or Enter on the row the arrow keys went to, goes to
// the state after that step. The saved state is marked, undone steps are pale, the present state is bold.
#pragma once

#include "history_model.hpp"

#include <jet/editor.hpp>

#include <QLabel>
#include <QListView>
#include <QWidget>

namespace jet::history {

class HistoryWidget final : public QWidget {
public:
    explicit HistoryWidget(Editor& editor);

    QListView* list() const { return list_; }
    QLabel* memory() const { return memory_; }

private:
    void watch(Scene* scene);
    void refresh();
    void goTo(const QModelIndex& index);

    Editor& editor_;
    HistoryModel model_;
    QListView* list_;
    QLabel* memory_;
    Subscription front_, changed_;
};

}  // namespace jet::history
