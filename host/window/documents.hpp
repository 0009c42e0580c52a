// Documents: the central tabs, one for each open scene and script.
#pragma once

#include "canvas/scene_view.hpp"
#include "window/script_tab.hpp"

#include <QTabWidget>

namespace jet::host {

class Documents final : public QTabWidget {
    Q_OBJECT

public:
    Documents(Editor& editor, ToolOptions& options, QWidget* parent);

    SceneView& openScene(Scene& scene);
    ScriptTab& openScript(Scene& scene, ItemId script, int line);
    /// The scenes that have a tab, of their own or of a script.
    std::vector<const Scene*> scenes() const;
    /// Closes the scene's tab and those of its scripts; what was typed there goes into the scene.
    void closeScene(const Scene& scene);
    void closeAll();
    void closeCurrent();

    /// The view in front; null while a script is.
    SceneView* currentView() const;
    /// The scene in front, or the one the script in front belongs to; null when nothing is open.
    Scene* currentScene() const;
    SceneView* viewOf(const Scene& scene) const;
    std::vector<SceneView*> views() const { return pages<SceneView>(); }
    /// Writes what was typed in script tabs into their scenes.
    void commitScripts();
    void updateTitles();

signals:
    /// Another scene, or another tab of it, came to the front.
    void frontChanged();
    void viewOpened(SceneView* view);
    /// About to close; the page is still whole.
    void viewClosing(SceneView* view);

private:
    template <class Page>
    std::vector<Page*> pages() const
    {
        std::vector<Page*> found;
        for (int i = 0; i < count(); ++i) {
            if (auto* page = qobject_cast<Page*>(widget(i))) found.push_back(page);
        }
        return found;
    }
    void addPage(QWidget* page, const char* icon, const QString& title);
    void closePage(QWidget* page);

    Editor& editor_;
    ToolOptions& options_;
};

}  // namespace jet::host
