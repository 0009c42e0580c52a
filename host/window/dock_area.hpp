// DockArea: the panels of plugins as docks, and the layout that is kept between runs.
//
// A panel is created when it is first seen. Docks whose plugin is absent this time keep their place: QMainWindow
// forgets what it cannot find, so an invisible stand-in of the same name is put there and saved again as it was.
#pragma once

#include "window/plugin_runtime.hpp"

#include <jet/editor.hpp>

#include <QDockWidget>
#include <QMap>
#include <QObject>
#include <QPointer>

#include <memory>
#include <vector>

class QMainWindow;
class QMenu;
class QSettings;

namespace jet {
class Panel;
}

namespace jet::host {

class DockArea final : public QObject {
    Q_OBJECT

public:
    DockArea(QMainWindow& window, Editor& editor);
    ~DockArea() override;

    /// A dock for each declared panel, in its default place.
    void createDocks();
    /// The same again after plugins were switched: panels that are gone are hidden and emptied, new ones are added.
    void rebuild();
    void restoreLayout(QSettings& settings);
    void saveLayout(QSettings& settings);
    /// Back to how a first start looks.
    void resetLayout();
    void fillMenu(QMenu& menu) const;

    /// Takes a plugin's panels out of their docks, which keep their places; refillContent() makes those anew that are
    /// seen. For plugins that are reloaded or switched off.
    void dropContent(const std::string& plugin);
    void refillContent();
    /// Puts the reason into the docks of plugins that were switched off since their panels were made.
    void showFailures(const PluginRuntime& plugins);

    /// Hides the panels for the documents' sake, and brings them back.
    void setMaximized(bool on);
    bool isMaximized() const { return maximized_; }

private:
    struct Dock {
        Contribution panel;
        QDockWidget* widget;
        std::unique_ptr<Panel> content;
        bool failed = false;
        bool gone = false;      // its plugin is switched off
        bool wasShown = false;  // before it went
    };

    Dock& createDock(Contribution panel);
    void bringUp(Dock& dock);
    void empty(Dock& dock);
    void fillWhenSeen(Dock& dock, bool visible);
    void placeDefault();
    void shareOut();
    void createStandIns(const QStringList& names);

    QMainWindow& window_;
    Editor& editor_;
    std::vector<std::unique_ptr<Dock>> docks_;
    QMap<QString, QPointer<QDockWidget>> standIns_;  // by object name; of absent panels
    QStringList shownStandIns_;
    QList<QDockWidget*> fronts_;  // of the default arrangement: one of each tab bar
    bool restored_ = false;       // the arrangement is the user's
    bool maximized_ = false;
    QList<QDockWidget*> hiddenByMaximize_;
};

}  // namespace jet::host
