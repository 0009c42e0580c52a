// WindowFixture: an editor window with built plugins, driven by Qt's own test events on the offscreen platform.
#pragma once

#include "support/test_catalog.hpp"
#include "window/main_window.hpp"

#include <jet/project.hpp>

#include <QTemporaryDir>

#include <gtest/gtest.h>

#include <memory>

namespace jet::test {

class WindowFixture : public testing::Test {
protected:
    /// With selection, rectangle and ellipse tools and the face effect.
    WindowFixture();
    explicit WindowFixture(std::initializer_list<std::string_view> plugins);
    ~WindowFixture() override;

    /// A fresh window with a new project, shown; what was open is closed as a user would.
    void start();
    void stop();
    host::MainWindow& window() { return *window_; }
    host::SceneView& view() { return *window_->documents().currentView(); }
    Scene& scene() { return *window_->activeScene(); }
    TestCatalog& catalog() { return catalog_; }
    std::filesystem::path folder(const char* name) const { return (folder_.path() + '/' + name).toStdString(); }

    void trigger(const char* action);
    bool isEnabled(const char* action);
    void key(int key, Qt::KeyboardModifiers modifiers = Qt::NoModifier);
    /// In pixels of the view, with the left button unless told otherwise.
    void drag(const QPoint& from, const QPoint& to, Qt::MouseButton button = Qt::LeftButton);
    void draw(const char* tool, const QPoint& from, const QPoint& to);
    std::vector<const Item*> shapes();

private:
    QTemporaryDir folder_;
    EventsCenter events_;
    TestCatalog catalog_;
    host::WindowLaunch launch_{catalog_, events_, {}, false, {}};
    std::unique_ptr<host::MainWindow> window_;
};

}  // namespace jet::test
