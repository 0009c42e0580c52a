#include "window/plugin_controller.hpp"

#include "window/settings_dialog.hpp"

#include <QMessageBox>
#include <QPushButton>

#include <algorithm>

namespace jet::host {

namespace {

QString textOf(const std::string& text) { return QString::fromStdString(text); }

}  // namespace

PluginController::PluginController(Editor& editor, ProjectController& projects, MessageBar& messages, QWidget* window)
    : QObject(window), editor_(editor), projects_(projects), messages_(messages), window_(window),
      ask_([this](const std::string& question) { return askTrust(question); })
{
    projects_.setBeforeOpen([this](const std::filesystem::path& project) { beforeOpen(project); });
    projects_.setMayOpen([this](const Project& project) { return mayOpen(project); });
    projects_.setTellMissing([this] { return tellMissing(); });
    subscription_ = editor_.events().subscribe<PluginsChanged>(
        nullptr, [this](const PluginsChanged& change) { pluginsChanged(change); });
}

std::vector<ActionSpec> PluginController::actions()
{
    return {{"edit.settings", QT_TRANSLATE_NOOP("Actions", "Se&ttings…"), "", "Ctrl+,", [this] {
                 SettingsDialog dialog(editor_, window_);
                 dialog.exec();
             }}};
}

// --- what is missing

MessageBar::Actions PluginController::actionsFor(const Provider& provider)
{
    MessageBar::Actions actions;
    if (provider.canEnable()) actions.push_back({tr("Enable"), [this, plugin = provider.plugin] { enable(plugin); }});
    return actions;
}

void PluginController::showMissing(ContributionKind kind, std::string_view id)
{
    const Provider provider = editor_.plugins().whoProvides(kind, id);
    messages_.add(textOf(provider.sentence), actionsFor(provider));
}

void PluginController::enable(const std::string& plugin)
{
    const Result<PluginChange> change = editor_.plugins().setEnabled(plugin, true);
    editor_.showMessage(change ? change->message : change.error().text());
}

std::set<PluginController::Wanted> PluginController::missingTypes() const
{
    std::set<Wanted> all, missing;
    if (!projects_.hasProject()) return missing;  // the plugins of the first project come in before it is read
    for (const Scene* scene : editor_.project().scenes()) {
        scene->root().walk([&](const Item& item) {
            if (!builtInItemType(item.type())) all.emplace(ContributionKind::ItemType, item.type());
            for (const EffectInstance& effect : item.effects()) all.emplace(ContributionKind::Effect, effect.type);
        });
    }
    // Catalogs without a manager say who provides a thing by provider() alone.
    for (const Wanted& wanted : all) {
        const Provider provider = editor_.plugins().whoProvides(wanted.first, wanted.second);
        const bool known = provider.availability == Availability::Usable ||
                           (provider.availability == Availability::Unknown &&
                            !editor_.catalog().provider(wanted.first, wanted.second).empty());
        if (!known) missing.insert(wanted);
    }
    return missing;
}

bool PluginController::mayOpen(const Project& project)
{
    if (!frozen_) return true;
    const auto differences = editor_.plugins().differences(project);
    if (differences.empty()) return true;
    std::string text =
        tr("The project is not opened, because its plugins are not those it was saved with:").toStdString();
    for (const PluginDifference& one : differences) text += "\n" + one.id + ": " + one.reason + "; " + one.remedy + ".";
    editor_.showMessage(text);
    return false;
}

bool PluginController::tellMissing()
{
    missing_ = missingTypes();
    const auto differences = editor_.plugins().differences(editor_.project());
    showDifferences(differences);
    std::set<std::string> told;
    for (const PluginDifference& one : differences) told.insert(one.id);
    const std::size_t shown = told.size();
    for (const auto& [kind, id] : missing_) {
        const Provider provider = editor_.plugins().whoProvides(kind, id);
        const std::string subject = provider.plugin.empty() ? id : provider.plugin;
        if (!told.insert(subject).second) continue;
        const QString kept = tr("%1 What it wrote is kept.").arg(textOf(provider.sentence));
        messages_.add(kept, actionsFor(provider));
    }
    return shown > 0 || !told.empty();
}

void PluginController::showDifferences(const std::vector<PluginDifference>& differences)
{
    const std::filesystem::path file = editor_.project().file();
    const bool again = answeredFor_ == file;
    if (!again) answered_.clear();
    answeredFor_ = file;
    bool isNew = false, versionsOnly = true;
    for (const PluginDifference& one : differences) {
        const std::string text = one.id + ": " + one.reason + "; " + one.remedy;
        editor_.print({OutputLine::Kind::Warning, Error(text, {file.string(), 0, 0}).text(), {}, 0});
        isNew = answered_.insert(one.id + one.wanted + one.here + one.reason).second || isNew;
        versionsOnly = versionsOnly && one.kind == PluginDifference::Kind::OtherVersion;
    }
    if (dialog_ && again) return dialog_->refresh();  // a plugin came back, and the project was read again
    if (dialog_) dialog_->close();                    // of the project before
    if (!isNew || (versionsOnly && !tellsOfVersions())) return;
    const auto compare = [this] { return editor_.plugins().differences(editor_.project()); };
    dialog_ = new PluginDiffDialog(editor_, textOf(editor_.project().name()), compare, window_);
    dialog_->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog_, &QDialog::finished, this, [this] { dialog_ = nullptr; });
    // Later: at the start the window itself is not shown yet.
    QMetaObject::invokeMethod(dialog_, &QDialog::open, Qt::QueuedConnection);
}

// --- plugins that change while the editor runs

void PluginController::pluginsChanged(const PluginsChanged& change)
{
    bool engine = false;
    for (const std::string& id : change.plugins) {
        const auto info = editor_.plugins().plugin(id);
        if (!info || info->isUsable()) continue;
        for (const Contribution& one : info->contributions)
            engine =
                engine || one.kind == ContributionKind::PhysicsEngine || one.kind == ContributionKind::ScriptEngine;
    }
    if (engine) editor_.simulation().stop();  // it would go on with an engine that is switched off
    // Later: the request may come from a panel that is about to go.
    QMetaObject::invokeMethod(
        this, [this] { emit changed(); }, Qt::QueuedConnection);
    const std::set<Wanted> still = missingTypes();
    const bool found =
        std::any_of(missing_.begin(), missing_.end(), [&](const Wanted& w) { return !still.contains(w); });
    if (found) offerToReopen();
}

// What a plugin that was absent wrote was read as raw text: only reading it again gives it its meaning.
void PluginController::offerToReopen()
{
    const std::filesystem::path file = editor_.project().file();
    if (file.empty()) return;
    if (!projects_.isModified()) {
        // Not from inside the event that told of the change: views are closed by this.
        QMetaObject::invokeMethod(
            this, [this, file] { projects_.open(file); }, Qt::QueuedConnection);
        return;
    }
    messages_.add(tr("The project is to be opened again, so that items of the plugin become editable."),
                  {{tr("Save and open again"), [this, file] {
                        if (projects_.save()) projects_.open(file);
                    }}});
}

// --- plugins that come with a project

void PluginController::beforeOpen(const std::filesystem::path& project)
{
    if (!useProjectPlugins_) return;
    const std::string told = useProjectPlugins_(project, ask_);
    if (!told.empty()) editor_.showMessage(told);
}

bool PluginController::askTrust(const std::string& question) const
{
    QMessageBox box(QMessageBox::Warning, tr("Plugins in the project"), textOf(question), QMessageBox::NoButton,
                    window_);
    box.setInformativeText(
        tr("Plugins are programs: they can do all that you can do on this computer. Use them only if "
           "you know where the project comes from. You are asked again when one of them changes."));
    const auto* use = box.addButton(tr("Trust and use them"), QMessageBox::AcceptRole);
    box.setDefaultButton(box.addButton(tr("Go on without them"), QMessageBox::RejectRole));
    box.exec();
    return box.clickedButton() == use;
}

}  // namespace jet::host
