// ScriptTab: a script item's code in an editor tab. What is typed becomes undo steps of the scene, one a pause.
#pragma once

#include "window/code_edit.hpp"

#include <jet/editor.hpp>

#include <QTimer>
#include <QWidget>

namespace jet::host {

class ScriptTab final : public QWidget {
    Q_OBJECT

public:
    ScriptTab(Scene& scene, ItemId script, Editor& editor, QWidget* parent);

    Scene& scene() const { return scene_; }
    ItemId script() const { return script_; }
    CodeEdit& code() const { return *code_; }
    QString title() const;
    /// Writes what was typed into the scene.
    void commit();

signals:
    void titleChanged();
    /// The script item was removed from its scene.
    void scriptGone();

private:
    const Item* item() const { return scene_.items().find(script_); }
    std::string stored() const;
    void follow();
    void showError(const OutputLine& line);

    Scene& scene_;
    ItemId script_;
    Editor& editor_;
    CodeEdit* code_;
    QTimer pause_;
    int session_ = 0;    // typing between two changes of focus is one undo step
    std::string known_;  // the scene's code as last seen or written here
    Subscription changed_, printed_, states_;
};

}  // namespace jet::host
