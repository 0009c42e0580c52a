// After a crash: asks whether to go on without the plugins it happened in, before any of them is loaded again.
#pragma once

#include "window/plugin_runtime.hpp"

#include <QDialog>

class QCheckBox;

namespace jet::host {

class CrashDialog final : public QDialog {
    Q_OBJECT

public:
    explicit CrashDialog(const std::vector<CrashNote>& crashes, QWidget* parent = nullptr);

    /// Each plugin once, in the order of the notes; those to be left out, after the dialog was accepted.
    std::vector<std::string> leftOut() const;

private:
    std::vector<std::pair<std::string, QCheckBox*>> choices_;
};

}  // namespace jet::host
