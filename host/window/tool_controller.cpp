#include "window/tool_controller.hpp"

#include <jet/ui/icons.hpp>
#include <jet/ui/property_editor.hpp>

#include <QCoreApplication>
#include <QLabel>
#include <QSettings>
#include <QToolBar>

#include <span>

namespace jet::host {

namespace {

QIcon iconFor(const Contribution& tool)
{
    const QIcon icon = tool.icon.empty() ? QIcon() : ui::iconFromFile(tool.icon);
    return icon.isNull() ? ui::icon("item") : icon;
}

QString toolTipFor(const Contribution& tool)
{
    const QString label = QCoreApplication::translate("Tools", tool.label.c_str());
    if (tool.shortcut.empty()) return label;
    return QStringLiteral("%1 (%2)").arg(label, QString::fromStdString(tool.shortcut));
}

}  // namespace

ToolController::ToolController(Editor& editor, Documents& documents, ToolOptions& options, QObject* parent)
    : QObject(parent), editor_(editor), documents_(documents), options_(options), buttons_(this),
      tools_(editor.catalog().contributions(ContributionKind::Tool))
{
    buttons_.setExclusive(true);
    if (!tools_.empty()) active_ = tools_.front().id;
}

void ToolController::rebuild()
{
    if (!bar_) return;
    for (QAction* button : buttons_.actions()) delete button;  // leaves the bar and the group
    tools_ = editor_.catalog().contributions(ContributionKind::Tool);
    const bool known =
        std::any_of(tools_.begin(), tools_.end(), [this](const auto& tool) { return tool.id == active_; });
    if (!known) active_ = tools_.empty() ? std::string() : tools_.front().id;
    buildToolBar(*bar_);
    applyToFront();
    if (!known) editor_.events().post(&editor_, ActiveToolChanged{active_});
}

void ToolController::buildToolBar(QToolBar& bar)
{
    bar_ = &bar;
    for (const Contribution& tool : tools_) {
        QAction* button = buttons_.addAction(iconFor(tool), QString::fromStdString(tool.label));
        button->setObjectName(QStringLiteral("tool:") + QString::fromStdString(tool.id));
        button->setToolTip(toolTipFor(tool));
        button->setCheckable(true);
        button->setChecked(tool.id == active_);
        connect(button, &QAction::triggered, this, [this, id = tool.id] {
            activate(id);
            if (SceneView* view = documents_.currentView()) view->setFocus();
        });
        bar.addAction(button);
    }
}

void ToolController::setOptionsBar(QToolBar& bar)
{
    optionsBar_ = &bar;
    showOptions();
}

void ToolController::activate(const std::string& id)
{
    const auto known = std::find_if(tools_.begin(), tools_.end(), [&](const Contribution& t) { return t.id == id; });
    if (known == tools_.end()) return editor_.showMissing(ContributionKind::Tool, id);
    if (id == active_) return;
    active_ = id;
    buttons_.actions().at(known - tools_.begin())->setChecked(true);
    editor_.showStatus({});
    applyToFront();
    editor_.events().post(&editor_, ActiveToolChanged{id});
}

void ToolController::applyToFront()
{
    SceneView* view = documents_.currentView();
    if (view && !active_.empty()) view->setTool(active_);
    showOptions();
}

void ToolController::setOption(std::string_view property, Value value)
{
    options_.set(active_, property, std::move(value));
    showOptions();
    if (SceneView* view = documents_.currentView()) view->update();
}

bool ToolController::trigger(const QKeySequence& keys)
{
    for (const Contribution& tool : tools_) {
        if (tool.shortcut.empty() || QKeySequence(QString::fromStdString(tool.shortcut)) != keys) continue;
        activate(tool.id);
        return true;
    }
    return false;
}

void ToolController::escape()
{
    SceneView* view = documents_.currentView();
    if (!view || view->cancelGesture()) return;
    if (!tools_.empty() && active_ != tools_.front().id) return activate(tools_.front().id);
    view->scene().items().setSelection({});
}

// --- options

void ToolController::showOptions()
{
    if (!optionsBar_) return;
    for (QAction* action : optionsBar_->actions()) {
        if (QWidget* widget = optionsBar_->widgetForAction(action)) widget->hide();
        optionsBar_->removeAction(action);
        action->deleteLater();  // with its widget, which may be the one that called
    }
    const SceneView* view = documents_.currentView();
    const Tool* tool = view && view->tool() ? view->tool()->tool() : nullptr;
    const auto contribution =
        std::find_if(tools_.begin(), tools_.end(), [this](const auto& t) { return t.id == active_; });
    if (contribution == tools_.end()) return;
    auto* name = new QLabel(QString::fromStdString(contribution->label), optionsBar_);
    name->setContentsMargins(6, 0, 14, 0);
    optionsBar_->addWidget(name);
    if (!tool) return;
    const PropertyTable& table = tool->options();
    if (table.specs().empty()) return;
    // A form for each: what does not fit into the bar goes below its overflow button one by one.
    for (const PropertySpec& one : table.specs()) {
        auto* form = new ui::PropertyForm(std::span(&one, 1), ui::PropertyForm::Layout::Line, optionsBar_);
        form->setContentsMargins(0, 0, 8, 0);
        form->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Preferred);
        form->show([&](const PropertySpec& spec) { return options_.of(active_).get(spec.id, table); });
        form->setHandler([this](const PropertySpec& spec, const Value& value, ui::EditPhase) {
            options_.set(active_, spec.id, value);
            if (SceneView* front = documents_.currentView()) front->update();
        });
        optionsBar_->addWidget(form);
    }
}

void ToolController::saveOptions(QSettings& settings) const
{
    // Text and kind: the tool's own table is not known before its plugin is loaded.
    for (const auto& [tool, values] : options_.all()) {
        for (const auto& [id, value] : values.entries()) {
            const QString key =
                QStringLiteral("tools/%1/%2").arg(QString::fromStdString(tool), QString::fromStdString(id));
            settings.setValue(key, QStringList{QString::number(static_cast<int>(value.kind())),
                                               QString::fromStdString(value.text())});
        }
    }
}

void ToolController::restoreOptions(QSettings& settings)
{
    settings.beginGroup("tools");
    for (const QString& tool : settings.childGroups()) {
        settings.beginGroup(tool);
        for (const QString& id : settings.childKeys()) {
            const QStringList stored = settings.value(id).toStringList();
            if (stored.size() != 2) continue;
            const Result<Value> value =
                Value::parse(static_cast<ValueKind>(stored[0].toInt()), stored[1].toStdString());
            if (value) options_.set(tool.toStdString(), id.toStdString(), *value);
        }
        settings.endGroup();
    }
    settings.endGroup();
}

}  // namespace jet::host
