// MessageBar: what the user must read, at the top of the window, without stopping the work. Repeated messages are
// counted.
#pragma once

#include <QFrame>
#include <QLabel>
#include <QVBoxLayout>

#include <functional>
#include <vector>

namespace jet::host {

class MessageBar final : public QFrame {
    Q_OBJECT

public:
    explicit MessageBar(QWidget* parent);

    /// A button of a message; the message goes when it is pressed.
    struct Action {
        QString label;
        std::function<void()> run;
    };
    using Actions = std::vector<Action>;

    void add(const QString& text, Actions actions = {});
    void clear();
    /// The newest message; empty when none is shown.
    QString text() const;

private:
    struct Row {
        QWidget* widget;
        QLabel* label;
        QString text;
        int count = 1;
    };

    QWidget* createRow(const QString& text, QLabel*& label, Actions actions);
    void remove(QWidget* row);

    QVBoxLayout* layout_;
    QList<Row> rows_;
};

}  // namespace jet::host
