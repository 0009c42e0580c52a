// PluginController: what the window does about plugins: says who provides what is missing and offers to enable it,
// follows when plugins are switched, asks whether to trust a project's own plugins, and shows their settings.
#pragma once

#include "window/actions.hpp"
#include "window/message_bar.hpp"
#include "window/plugin_diff_dialog.hpp"
#include "window/project_controller.hpp"

#include <jet/plugins.hpp>

#include <QPointer>

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <utility>

namespace jet::host {

/// Brings in the plugins beside a project; `ask` is asked whether to trust them. Returns what the user should know.
using UseProjectPlugins = std::function<std::string(const std::filesystem::path& project,
                                                    const std::function<bool(const std::string&)>& ask)>;

class PluginController final : public QObject {
    Q_OBJECT

public:
    PluginController(Editor& editor, ProjectController& projects, MessageBar& messages, QWidget* window);

    std::vector<ActionSpec> actions();
    void showMissing(ContributionKind kind, std::string_view id);
    void setUseProjectPlugins(UseProjectPlugins use) { useProjectPlugins_ = std::move(use); }
    /// Projects open only with exactly the plugins they were saved with.
    void setFrozen(bool frozen) { frozen_ = frozen; }
    /// What the open project wants and does not get, while it is shown; null otherwise.
    PluginDiffDialog* differencesShown() const { return dialog_; }
    /// Replaces the question whether to trust a project's plugins, for tests.
    void setQuestion(std::function<bool(const std::string&)> ask) { ask_ = std::move(ask); }

signals:
    /// What the catalog offers has changed: bars, menus and docks are to be made again.
    void changed();

private:
    using Wanted = std::pair<ContributionKind, std::string>;

    void beforeOpen(const std::filesystem::path& project);
    /// Shows which plugins are not as the project wants them; what no plugin is known for is a message each. False when
    /// all is well.
    bool tellMissing();
    /// False: the project must not open with these plugins (frozen); says why.
    bool mayOpen(const Project& project);
    void showDifferences(const std::vector<PluginDifference>& differences);
    std::set<Wanted> missingTypes() const;
    void enable(const std::string& plugin);
    void pluginsChanged(const PluginsChanged& change);
    void offerToReopen();
    bool askTrust(const std::string& question) const;
    MessageBar::Actions actionsFor(const Provider& provider);

    Editor& editor_;
    ProjectController& projects_;
    MessageBar& messages_;
    QWidget* window_;
    UseProjectPlugins useProjectPlugins_;
    std::function<bool(const std::string&)> ask_;
    bool frozen_ = false;
    std::set<Wanted> missing_;  // when the project was opened
    QPointer<PluginDiffDialog> dialog_;
    std::filesystem::path answeredFor_;  // the project that answered_ is about
    std::set<std::string> answered_;     // differences that were shown: reading the project again shows new ones only
    Subscription subscription_;
};

}  // namespace jet::host
