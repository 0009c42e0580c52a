// SettingsDialog: a page for each plugin that declares one, made from its property table. Values are stored as they are
// changed; a plugin is loaded when its page is first seen.
#pragma once

#include <jet/editor.hpp>

#include <QDialog>
#include <QHash>

class QLabel;
class QListWidget;
class QPushButton;
class QStackedWidget;

namespace jet::ui {
class PropertyForm;
}

namespace jet::host {

class SettingsDialog final : public QDialog {
    Q_OBJECT

public:
    SettingsDialog(Editor& editor, QWidget* parent);
    void showPage(const QString& id);

private:
    void showRow(int row);
    QWidget* createPage(const QString& id);
    void showValues(const QString& id);
    void restoreDefaults();

    Editor& editor_;
    QListWidget* list_;
    QStackedWidget* pages_;
    QPushButton* defaults_;
    QHash<QString, QWidget*> made_;
    QHash<QString, ui::PropertyForm*> forms_;
};

}  // namespace jet::host
