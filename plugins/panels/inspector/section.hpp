// Section: a titled part of the Inspector that folds, with small buttons on the right of its title.
#pragma once

#include <QToolButton>
#include <QVBoxLayout>
#include <QWidget>

#include <functional>

namespace jet::inspector {

class Section final : public QWidget {
public:
    Section(const QString& title, QWidget* parent);

    /// Below what is there already.
    void addContent(QWidget* content);
    QToolButton* addButton(const char* icon, const QString& toolTip, std::function<void()> clicked);

private:
    QVBoxLayout* layout_;
    QHBoxLayout* bar_;
    QToolButton* title_;
    QWidget* content_;
};

}  // namespace jet::inspector
