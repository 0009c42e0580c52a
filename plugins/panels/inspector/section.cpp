#include "section.hpp"

#include <jet/ui/icons.hpp>

#include <QHBoxLayout>

namespace jet::inspector {

Section::Section(const QString& title, QWidget* parent)
    : QWidget(parent), layout_(new QVBoxLayout(this)), bar_(new QHBoxLayout), title_(new QToolButton(this)),
      content_(new QWidget(this))
{
    layout_->setContentsMargins(0, 0, 0, 0);
    layout_->setSpacing(2);
    auto* head = new QWidget(this);
    head->setAutoFillBackground(true);
    head->setBackgroundRole(QPalette::Button);
    head->setLayout(bar_);
    bar_->setContentsMargins(2, 1, 2, 1);
    bar_->setSpacing(0);
    title_->setText(title);
    title_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    title_->setArrowType(Qt::DownArrow);
    title_->setAutoRaise(true);
    title_->setCheckable(true);
    title_->setChecked(true);
    title_->setStyleSheet("QToolButton { border: none; background: transparent; font-weight: bold; padding: 3px; }");
    connect(title_, &QToolButton::toggled, this, [this](bool open) {
        title_->setArrowType(open ? Qt::DownArrow : Qt::RightArrow);
        content_->setVisible(open);
    });
    bar_->addWidget(title_);
    bar_->addStretch(1);
    layout_->addWidget(head);
    layout_->addWidget(content_);
    auto* contents = new QVBoxLayout(content_);
    contents->setContentsMargins(8, 4, 8, 8);
    contents->setSpacing(4);
}

void Section::addContent(QWidget* content) { content_->layout()->addWidget(content); }

QToolButton* Section::addButton(const char* icon, const QString& toolTip, std::function<void()> clicked)
{
    auto* button = new QToolButton(this);
    button->setIcon(ui::icon(icon));
    button->setToolTip(toolTip);
    button->setAutoRaise(true);
    button->setIconSize(QSize(14, 14));
    connect(button, &QToolButton::clicked, this, [clicked = std::move(clicked)] {
        const std::function<void()> call = clicked;  // a copy: the call may take this section away
        call();
    });
    bar_->addWidget(button);
    return button;
}

}  // namespace jet::inspector
