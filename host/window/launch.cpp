#include "window/launch.hpp"

#include "window/main_window.hpp"
#include "window/theme.hpp"

#include <QApplication>

#include <clocale>

int jet_run_window(int argc, char** argv, const jet::host::WindowLaunch& launch)
{
    QApplication application(argc, argv);
    std::setlocale(LC_NUMERIC, "C");  // QApplication sets the user's: numbers in files and scripts have a point
    QApplication::setApplicationName("JET");
    QApplication::setDesktopFileName("jet");
    jet::host::applyTheme(application);
    jet::host::MainWindow window(launch);
    window.restoreSettings();
    if (launch.project.empty() || !window.projects().open(launch.project)) window.projects().create();
    window.show();
    return QApplication::exec();
}
