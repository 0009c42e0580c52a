#include "window/message_bar.hpp"

#include <jet/ui/icons.hpp>

#include <QHBoxLayout>
#include <QPushButton>
#include <QToolButton>

namespace jet::host {

namespace {

constexpr int kMostRows = 4;  // more would hide the scene; the oldest goes

}  // namespace

MessageBar::MessageBar(QWidget* parent) : QFrame(parent), layout_(new QVBoxLayout(this))
{
    layout_->setContentsMargins(0, 0, 0, 0);
    layout_->setSpacing(1);
    setObjectName("messageBar");
    setStyleSheet("#messageBar { background: #1f2124; } #messageRow { background: #5a4a1e; } #messageRow QLabel { "
                  "color: #fff2cc; }");
    hide();
}

void MessageBar::add(const QString& text, Actions actions)
{
    for (Row& row : rows_) {
        if (row.text != text) continue;
        row.label->setText(tr("%1 (%2 times)").arg(text).arg(++row.count));
        return;
    }
    if (rows_.size() == kMostRows) remove(rows_.front().widget);
    Row row{nullptr, nullptr, text};
    row.widget = createRow(text, row.label, std::move(actions));
    rows_ << row;
    layout_->addWidget(row.widget);
    show();
}

QWidget* MessageBar::createRow(const QString& text, QLabel*& label, Actions actions)
{
    auto* row = new QFrame(this);
    row->setObjectName("messageRow");
    auto* layout = new QHBoxLayout(row);
    layout->setContentsMargins(10, 4, 4, 4);
    auto* sign = new QLabel(row);
    sign->setPixmap(ui::icon("warning").pixmap(16));
    label = new QLabel(text, row);
    label->setTextFormat(Qt::PlainText);
    label->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
    label->setWordWrap(true);
    auto* close = new QToolButton(row);
    close->setIcon(ui::icon("close"));
    close->setAutoRaise(true);
    close->setToolTip(tr("Close"));
    connect(close, &QToolButton::clicked, this, [this, row] { remove(row); });
    layout->addWidget(sign);
    layout->addWidget(label, 1);
    for (Action& action : actions) {
        auto* button = new QPushButton(action.label, row);
        button->setObjectName("messageAction");
        connect(button, &QPushButton::clicked, this, [this, row, run = std::move(action.run)] {
            remove(row);
            run();
        });
        layout->addWidget(button, 0, Qt::AlignTop);
    }
    layout->addWidget(close, 0, Qt::AlignTop);
    return row;
}

void MessageBar::remove(QWidget* widget)
{
    rows_.removeIf([widget](const Row& row) { return row.widget == widget; });
    layout_->removeWidget(widget);
    widget->hide();
    widget->deleteLater();
    setVisible(!rows_.isEmpty());
}

void MessageBar::clear()
{
    while (!rows_.isEmpty()) remove(rows_.front().widget);
}

QString MessageBar::text() const { return rows_.isEmpty() ? QString() : rows_.back().text; }

}  // namespace jet::host
