// The query, what it finds in the front scene, and buttons. Results follow the query as it is typed and the scene as it
// changes, once a frame. Enter and Shift+Enter go to the next and the previous one, Ctrl+Enter selects all.
#pragma once

#include "find_model.hpp"

#include <jet/editor.hpp>
#include <jet/find.hpp>

#include <QLabel>
#include <QLineEdit>
#include <QListView>
#include <QWidget>

namespace jet::find {

class FindWidget final : public QWidget {
    Q_OBJECT

public:
    explicit FindWidget(Editor& editor);

protected:
    void focusInEvent(QFocusEvent* event) override;
    bool eventFilter(QObject* object, QEvent* event) override;

private:
    void watch(Scene* scene);
    void readQuery();
    void search();
    void tell();
    void step(int by);
    void goTo(const QModelIndex& index);
    void selectAll();

    Editor& editor_;
    Scene* scene_ = nullptr;
    FindQuery query_;
    std::string problem_;
    FindModel model_;
    QLineEdit* line_;
    QLabel* note_;
    QListView* list_;
    Subscription front_, changed_;
};

}  // namespace jet::find
