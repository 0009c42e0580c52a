#include "inspector_widget.hpp"

#include <jet/arrange.hpp>
#include <jet/ui/icons.hpp>
#include <jet/ui/text_frame.hpp>

#include <QCoreApplication>
#include <QMenu>
#include <QPushButton>
#include <QScrollBar>

namespace jet::inspector {

using ui::EditPhase;
using ui::PropertyForm;

namespace {

constexpr int kRefreshMs = 30;
constexpr double kSmallestSize = 1e-6;  // scene units; a size of 0 could never be scaled back

QString translated(const char* text) { return QCoreApplication::translate("Inspector", text); }

/// What every item has.
const PropertyTable& commonTable()
{
    static const PropertyTable table{text("name", "Name", ""), flag("visible", "Visible", true),
                                     flag("locked", "Locked", false)};
    return table;
}

const PropertyTable& geometryTable()
{
    static const PropertyTable table{
        vector("position", "Position", {0, 0}).in("units").says("Top-left corner of the bounding box."),
        vector("size", "Size", {0, 0}).in("units").range(0, 1e9).says("Of the bounding box."),
    };
    return table;
}

/// The scene's settings, with the installed engines to choose from.
std::vector<PropertySpec> settingsOf(const Catalog& catalog)
{
    const auto declared = Scene::settingsTable().specs();
    std::vector<PropertySpec> specs(declared.begin(), declared.end());
    for (PropertySpec& spec : specs) {
        if (spec.id != "physics") continue;
        spec.kind = ValueKind::Choice;
        spec.choices = {""};
        for (const Contribution& one : catalog.contributions(ContributionKind::PhysicsEngine))
            spec.choices.push_back(one.id);
    }
    return specs;
}

/// A stored property of an effect whose plugin is absent, to be read only.
PropertyTable rawTable(const std::string& id)
{
    PropertySpec spec;
    spec.id = spec.label = id;
    spec.kind = ValueKind::Raw;
    return PropertyTable{std::move(spec)};
}

}  // namespace

InspectorWidget::InspectorWidget(Editor& editor) : editor_(editor)
{
    setWidgetResizable(true);
    setFrameShape(QFrame::NoFrame);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    setMinimumWidth(230);
    soon_.setSingleShot(true);
    connect(&soon_, &QTimer::timeout, this, [this] { refresh(); });
    front_ = editor.events().subscribe<ActiveSceneChanged>(
        nullptr, [this](const ActiveSceneChanged& event) { watch(event.scene); });
    watch(editor.activeScene());
}

void InspectorWidget::watch(Scene* scene)
{
    scene_ = scene;
    changed_.reset();
    selected_.reset();
    touched_.reset();
    if (scene) {
        EventsCenter& events = editor_.events();
        changed_ = events.subscribe<ItemsChanged>(scene, [this](const ItemsChanged&) { refreshSoon(); });
        selected_ = events.subscribe<SelectionChanged>(scene, [this](const SelectionChanged&) { refreshSoon(); });
        touched_ = events.subscribe<SceneTouched>(scene, [this](const SceneTouched&) { refreshSoon(); });
    }
    rebuild();
}

void InspectorWidget::refreshSoon()
{
    if (!soon_.isActive()) soon_.start(kRefreshMs);
}

void InspectorWidget::refresh()
{
    if (!scene_) return;
    const Subject before = std::exchange(subject_, Subject(*scene_));
    if (!subject_.sameOutline(before)) return rebuild();
    for (const auto& [form, source] : forms_) form->show(source);
}

// --- building

void InspectorWidget::rebuild()
{
    const int scroll = verticalScrollBar()->value();
    subject_ = scene_ ? Subject(*scene_) : Subject();
    forms_.clear();
    if (QWidget* old = takeWidget()) {
        old->hide();
        old->deleteLater();  // one of its editors may be what called us
    }
    body_ = new QWidget(this);
    auto* layout = new QVBoxLayout(body_);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(6);
    if (scene_ && subject_.isEmpty()) addSceneSections();
    if (scene_ && !subject_.isEmpty()) {
        addItemSection();
        addGeometrySection();
        addTypeSection();
        for (const SharedEffect& effect : subject_.effects()) addEffectSection(effect);
        addEffectButton();
    }
    layout->addStretch(1);
    setWidget(body_);
    verticalScrollBar()->setValue(scroll);
}

Section& InspectorWidget::addSection(const QString& title)
{
    auto* section = new Section(title, body_);
    body_->layout()->addWidget(section);
    return *section;
}

PropertyForm* InspectorWidget::addForm(Section& section, std::span<const PropertySpec> specs,
                                       PropertyForm::Source source, PropertyForm::Handler handler)
{
    auto* form = new PropertyForm(specs, PropertyForm::Layout::Rows, &section);
    form->show(source);
    form->setHandler(std::move(handler));
    section.addContent(form);
    forms_.emplace_back(form, std::move(source));
    return form;
}

void InspectorWidget::addSceneSections()
{
    Section& section = addSection(translated("Scene"));
    addForm(
        section, settingsOf(editor_.catalog()), [this](const PropertySpec& spec) { return scene_->setting(spec.id); },
        [this](const PropertySpec& spec, const Value& value, EditPhase phase) {
            edit("Change scene", "scene-" + spec.id, phase, [&](Transaction& e) { e.setScene(spec.id, value); });
        });
}

void InspectorWidget::addItemSection()
{
    const std::size_t count = subject_.items().size();
    const ItemType* type = subject_.type().empty() ? nullptr : typeOf(editor_.catalog(), subject_.type());
    const QString label = type                      ? QString::fromStdString(type->label())
                          : subject_.type().empty() ? translated("Items")
                                                    : QString::fromStdString(subject_.type());
    Section& section = addSection(count == 1 ? label : QStringLiteral("%1 (%2)").arg(label).arg(count));
    addForm(
        section, commonTable(), [this](const PropertySpec& spec) { return subject_.common(spec.id, spec.fallback); },
        [this](const PropertySpec& spec, const Value& value, EditPhase phase) {
            editItems("Change " + spec.id, spec.id, phase,
                      [&](Transaction& e, const Item& item) { e.set(item, spec.id, value); });
        });
}

void InspectorWidget::addGeometrySection()
{
    if (subject_.bounds().isNull()) return;
    Section& section = addSection(translated("Geometry"));
    addForm(
        section, geometryTable(),
        [this](const PropertySpec& spec) -> std::optional<Value> {
            const jet::Box box = subject_.bounds();
            return spec.id == "position" ? Value(box.min) : Value(box.size());
        },
        [this](const PropertySpec& spec, const Value& value, EditPhase phase) { changeGeometry(spec, value, phase); });
}

void InspectorWidget::changeGeometry(const PropertySpec& spec, const Value& value, EditPhase phase)
{
    const jet::Box box = Subject(*scene_).bounds();  // now, not at the last refresh
    const Vec2 wanted = value.as<Vec2>();
    Affine change = Affine::translation(wanted - box.min);
    if (spec.id == "size") {
        const Vec2 now = box.size().cwiseMax(kSmallestSize);
        const Vec2 factor(box.width() < kSmallestSize ? 1 : std::max(wanted.x(), kSmallestSize) / now.x(),
                          box.height() < kSmallestSize ? 1 : std::max(wanted.y(), kSmallestSize) / now.y());
        change = Affine::scaling(factor, box.min);
    }
    // What is in a selected group moves with the group, and not once more by itself.
    edit("Transform", spec.id, phase, [&](Transaction& e) {
        for (const Item* item : topSelection(*scene_)) e.transform(*item, change);
    });
}

void InspectorWidget::addTypeSection()
{
    const std::vector<PropertySpec> shared = sharedProperties(editor_.catalog(), subject_.types());
    if (shared.empty()) return;
    Section& section = addSection(translated("Properties"));
    const bool oneScript = subject_.type() == ScriptItem::type && subject_.items().size() == 1;
    if (oneScript) {
        auto* open = new QPushButton(ui::icon("script"), translated("Open script tab"), &section);
        connect(open, &QPushButton::clicked, this,
                [this, id = subject_.items().front()->id()] { editor_.openScript(*scene_, id); });
        section.addContent(open);
        return;
    }
    const auto source = [this](const PropertySpec& spec) { return subject_.common(spec.id, spec.fallback); };
    const auto handler = [this](const PropertySpec& spec, const Value& value, EditPhase phase) {
        editItems("Change " + spec.label, spec.id, phase, [&](Transaction& e, const Item& item) {
            e.set(item, spec.id, resolved(value, item.property(spec.id).value_or(spec.fallback)));
            if (item.is<TextItem>() && ui::shapesText(spec.id)) e.setPath(item, ui::fittedTextFrame(item));
        });
    };
    if (!subject_.type().empty()) {
        addForm(section, typeOf(editor_.catalog(), subject_.type())->properties(), source, handler);
        return;
    }
    for (const PropertySpec& spec : shared) addForm(section, PropertyTable{spec}, source, handler);
}

// --- effects

QString InspectorWidget::effectLabel(const std::string& id) const
{
    for (const Contribution& effect : editor_.catalog().contributions(ContributionKind::Effect)) {
        if (effect.id == id) return QString::fromStdString(effect.label);
    }
    return QStringLiteral("%1 (%2)").arg(QString::fromStdString(id), translated("not installed"));
}

void InspectorWidget::addEffectSection(const SharedEffect& shared)
{
    Section& section = addSection(effectLabel(shared.type));
    addEffectButtons(section, shared);
    const auto source = [this, shared](const PropertySpec& spec) {
        return subject_.common(shared, spec.id, spec.fallback);
    };
    const Effect* effect = editor_.catalog().effect(shared.type);
    if (!effect) {
        section.setToolTip(QString::fromStdString(editor_.catalog().explain(ContributionKind::Effect, shared.type)));
        const Item& first = *subject_.items().front();
        for (const auto& entry : first.effects()[*indexOf(first, shared)].properties.entries()) {
            addForm(section, rawTable(entry.first), source, {});
        }
        return;
    }
    addForm(section, effect->properties(), source,
            [this, shared](const PropertySpec& spec, const Value& value, EditPhase phase) {
                editEffect("Change " + spec.label, shared, shared.type + '.' + spec.id, phase,
                           [&](Transaction& e, const Item& item, std::size_t index) {
                               const Value present = effectValue(item, index, spec.id, spec.fallback);
                               e.setEffect(item, index, spec.id, resolved(value, present));
                           });
            });
}

void InspectorWidget::addEffectButtons(Section& section, const SharedEffect& shared)
{
    const bool shown = subject_.common(shared, "visible", true) != std::optional<Value>(false);
    section.addButton(shown ? "eye" : "eye-off", translated("Shown or hidden"), [this, shared, shown] {
        editEffect(
            "Show or hide effect", shared, "", EditPhase::Done,
            [&](Transaction& e, const Item& item, std::size_t index) { e.setEffect(item, index, "visible", !shown); });
        rebuild();  // the eye is part of the outline
    });
    const auto move = [this, shared](int by) {
        editEffect("Reorder effects", shared, "", EditPhase::Done,
                   [&](Transaction& e, const Item& item, std::size_t from) {
                       const std::ptrdiff_t to = static_cast<std::ptrdiff_t>(from) + by;
                       if (to < 0 || to >= static_cast<std::ptrdiff_t>(item.effects().size())) return;
                       e.moveEffect(item, from, static_cast<std::size_t>(to));
                   });
    };
    section.addButton("up", translated("Paint earlier"), [move] { move(-1); });
    section.addButton("down", translated("Paint later"), [move] { move(1); });
    section.addButton("close", translated("Remove effect"), [this, shared] {
        editEffect("Remove effect", shared, "", EditPhase::Done,
                   [&](Transaction& e, const Item& item, std::size_t index) { e.removeEffect(item, index); });
    });
}

void InspectorWidget::addEffectButton()
{
    auto* button = new QPushButton(ui::icon("plus"), translated("Add effect"), body_);
    auto* menu = new QMenu(button);
    for (const Contribution& effect : editor_.catalog().contributions(ContributionKind::Effect)) {
        connect(menu->addAction(QString::fromStdString(effect.label)), &QAction::triggered, this,
                [this, id = effect.id] { addEffect(id); });
    }
    button->setMenu(menu);
    button->setEnabled(!menu->isEmpty());
    body_->layout()->addWidget(button);
}

void InspectorWidget::addEffect(const std::string& id)
{
    const Effect* effect = editor_.catalog().effect(id);
    if (!effect) return editor_.showMissing(ContributionKind::Effect, id);
    editItems("Add effect", "", EditPhase::Done, [&](Transaction& e, const Item& item) {
        if (const std::string why = effect->rejects(item); !why.empty())
            return editor_.showMessage(item.name() + ": " + why);
        e.addEffect(item, id);
        effect->applied(e, item);
    });
}

// --- changing

void InspectorWidget::editItems(std::string_view label, const std::string& key, EditPhase phase,
                                const std::function<void(Transaction&, const Item&)>& change)
{
    edit(label, key, phase, [&](Transaction& e) {
        for (const ItemId id : std::vector(scene_->items().selection())) {
            if (const Item* item = scene_->items().find(id)) change(e, *item);
        }
    });
}

void InspectorWidget::editEffect(std::string_view label, const SharedEffect& effect, const std::string& key,
                                 EditPhase phase,
                                 const std::function<void(Transaction&, const Item&, std::size_t)>& change)
{
    editItems(label, key, phase, [&](Transaction& e, const Item& item) {
        if (const std::optional<std::size_t> index = indexOf(item, effect)) change(e, item, *index);
    });
}

void InspectorWidget::edit(std::string_view label, const std::string& key, EditPhase phase,
                           const std::function<void(Transaction&)>& change)
{
    if (scene_->items().inTransaction()) return refreshSoon();  // a drag is going on in the scene
    try {
        auto transaction = scene_->items().begin(label);
        change(transaction);
        transaction.commit(key.empty() ? std::string() : "inspector-" + key + '-' + std::to_string(gesture_));
    } catch (const std::exception& problem) {
        editor_.showMessage(problem.what());
    }
    if (phase == EditPhase::Done) ++gesture_;
    refreshSoon();
}

}  // namespace jet::inspector
