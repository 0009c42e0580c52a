// SetChooser: which plugin set is in use; chooses another one, or saves what is in use as one.
#pragma once

#include <jet/editor.hpp>
#include <jet/plugins.hpp>

#include <QComboBox>

#include <functional>
#include <vector>

namespace jet::plugins {

class SetChooser final : public QComboBox {
public:
    SetChooser(Editor& editor, QWidget* parent);

    /// Told what a choice did.
    std::function<void(const Result<PluginChange>&)> onChange;
    /// Asks for the name of a set to save; empty: given up. Replaced by tests.
    std::function<QString(const QString& proposed)> askName;

    /// Reads anew which sets there are. Hidden where the host has none.
    void refresh();
    void use(const std::string& name);
    void save();

private:
    void choose(int row);
    void addSet(const PluginSetInfo& set);

    Editor& editor_;
    std::vector<PluginSetInfo> sets_;
};

}  // namespace jet::plugins
