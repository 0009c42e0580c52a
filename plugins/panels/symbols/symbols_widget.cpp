#include "symbols_widget.hpp"

#include "thumbnail.hpp"

#include <jet/arrange.hpp>
#include <jet/find.hpp>
#include <jet/symbols.hpp>

#include <QMimeData>
#include <QTimer>
#include <QVBoxLayout>

#include <algorithm>

namespace jet::symbol_list {

namespace {

const QSize kPicture(72, 48);
constexpr int kIdRole = Qt::UserRole, kWhileTypingMs = 200;
constexpr std::string_view kDrag = "org.jet.panel.symbols/";
constexpr double kAside = 20;  // scene units: an instance does not hide the one before

/// Where new things go: the active layer, else the top-most one that is not locked.
const Item& placeFor(Editor& editor, const Scene& scene)
{
    const auto fits = [](const Item* item) {
        return item && item->is<LayerItem>() && item->editable() && item->shown();
    };
    if (const Item* active = scene.items().find(editor.activeLayer()); fits(active)) return *active;
    const auto layers = scene.root().children();
    for (auto layer = layers.rbegin(); layer != layers.rend(); ++layer)
        if (fits(layer->get())) return **layer;
    return scene.root();
}

/// Its rows can be dragged onto the scene.
class SymbolList final : public QListWidget {
public:
    explicit SymbolList(QWidget* parent) : QListWidget(parent)
    {
        setDragEnabled(true);
        setDragDropMode(DragOnly);
    }

protected:
    QStringList mimeTypes() const override { return {ui::kSceneDrag}; }
    QMimeData* mimeData(const QList<QListWidgetItem*>& items) const override
    {
        if (items.isEmpty()) return nullptr;
        auto* data = new QMimeData;
        data->setData(ui::kSceneDrag, QByteArray(kDrag.data(), qsizetype(kDrag.size())) +
                                          QByteArray::number(items.front()->data(kIdRole).toULongLong()));
        return data;
    }
};

}  // namespace

SymbolsWidget::SymbolsWidget(Editor& editor) : editor_(editor), list_(new SymbolList(this)), bar_(makeBar())
{
    list_->setObjectName("symbol-list");
    list_->setAccessibleName(tr("Symbols"));
    list_->setIconSize(kPicture);
    list_->setUniformItemSizes(true);
    list_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(list_);
    layout->addWidget(bar_);
    setFocusProxy(list_);
    connect(list_, &QListWidget::itemDoubleClicked, this, [this] { run(commands()[1]); });
    connect(list_, &QListWidget::itemChanged, this, [this](QListWidgetItem* row) {
        if (!building_) giveName(*row);
    });
    front_ = editor.events().subscribe<ActiveSceneChanged>(
        nullptr, [this](const ActiveSceneChanged& event) { watch(event.scene); });
    dropped_ = editor.events().subscribe<ui::DroppedOnScene>(
        nullptr, [this](const ui::DroppedOnScene& drop) { takeDrop(drop); });
    watch(editor.activeScene());
}

void SymbolsWidget::watch(Scene* scene)
{
    scene_ = scene;
    changed_.reset();
    if (scene)
        changed_ = editor_.events().subscribeCoalesced<ItemsChanged>(scene, [this](const ItemsChanged::Burst& burst) {
            if (isVisible() && concerns(burst)) rebuild();
        });
    rebuild();
}

void SymbolsWidget::showEvent(QShowEvent* event)
{
    QWidget::showEvent(event);
    rebuild();
}

bool SymbolsWidget::concerns(const ItemsChanged::Burst& burst) const
{
    if (burst.tree) return true;
    return std::ranges::any_of(burst.items, [&](ItemId id) {
        const Item* item = scene_->items().find(id);
        return item && (isSymbol(*item) || isInstance(*item) || holderOf(*item));
    });
}

// Rows of symbols that were there stay: a click, a drag or a name being typed goes on.
void SymbolsWidget::rebuild()
{
    if (bar_->isTyping()) return QTimer::singleShot(kWhileTypingMs, this, &SymbolsWidget::rebuild);
    const auto symbols = scene_ ? symbolsOf(*scene_) : std::vector<const Item*>();
    const auto idOf = [this](int row) { return list_->item(row)->data(kIdRole).toULongLong(); };
    building_ = true;
    for (int row = 0; row < static_cast<int>(symbols.size()); ++row) {
        const Item& symbol = *symbols[static_cast<std::size_t>(row)];
        while (row < list_->count() && idOf(row) != symbol.id().value &&
               std::ranges::none_of(symbols, [&](const Item* one) { return one->id().value == idOf(row); }))
            delete list_->takeItem(row);
        if (row >= list_->count() || idOf(row) != symbol.id().value) {
            auto* made = new QListWidgetItem;
            made->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsEditable);
            made->setData(kIdRole, static_cast<qulonglong>(symbol.id().value));
            list_->insertItem(row, made);
        }
        showSymbol(*list_->item(row), symbol);
    }
    while (list_->count() > static_cast<int>(symbols.size())) delete list_->takeItem(list_->count() - 1);
    building_ = false;
}

void SymbolsWidget::showSymbol(QListWidgetItem& row, const Item& symbol)
{
    row.setText(QString::fromStdString(symbol.name()));
    row.setIcon(QIcon(thumbnailOf(*scene_, symbol, kPicture, devicePixelRatioF())));
    row.setToolTip(
        tr("%n instance(s) in this scene. Dragged into the scene, or by a double click, another one is placed.",
           nullptr, static_cast<int>(instancesOf(*scene_, symbol).size())));
}

const Item* SymbolsWidget::current() const
{
    const QListWidgetItem* row = list_->currentItem();
    return scene_ && row ? scene_->items().find(ItemId{row->data(kIdRole).toULongLong()}) : nullptr;
}

// --- buttons, menu and keys

std::span<const SymbolsWidget::Command> SymbolsWidget::commands()
{
    using W = SymbolsWidget;
    static const Command all[] = {
        {"plus", QT_TR_NOOP("Make a symbol of the selection"), &W::create, "", false, true},
        {"import", QT_TR_NOOP("Place"), &W::place, "Return", true, true},
        {"edit", QT_TR_NOOP("Edit in its first instance"), &W::edit, "", true, true},
        {"frame", QT_TR_NOOP("Select all instances"), &W::selectInstances, "", true, true},
        {"ungroup", QT_TR_NOOP("Detach the selected instances"), &W::detach, "", true, true},
        {"item", QT_TR_NOOP("Rename"), &W::rename, "F2", true, false},
        {"trash", QT_TR_NOOP("Delete"), &W::remove, "Del", true, true},
    };
    return all;
}

ui::CommandBar* SymbolsWidget::makeBar()
{
    std::vector<ui::PanelCommand> all;
    for (const Command& command : commands())
        all.push_back({command.icon, command.text, tr(command.text), [this, &command] { run(command); },
                       [this, &command] { return scene_ && (!command.needsSymbol || current()); }, command.key,
                       command.onBar});
    return new ui::CommandBar(*list_, std::move(all), this);
}

void SymbolsWidget::run(const Command& command)
{
    if (!scene_ || scene_->items().inTransaction()) return;
    if (command.needsSymbol && !current())
        return editor_.showStatus(tr("Select a symbol in the list first.").toStdString());
    try {
        (this->*command.run)();
    } catch (const std::exception& problem) {
        editor_.showMessage(problem.what());
    }
}

// --- commands

void SymbolsWidget::create()
{
    auto edit = scene_->items().begin("Create symbol");
    const Item* instance = createSymbol(edit, *scene_, topSelection(*scene_));
    if (!instance)
        return editor_.showMessage(
            tr("Select what shall become a symbol in the scene first. Layers cannot.").toStdString());
    const ItemId symbol = linkOf(*instance);
    edit.select(*instance);
    edit.commit();
    rebuild();
    for (int i = 0; i < list_->count(); ++i)
        if (list_->item(i)->data(kIdRole).toULongLong() == symbol.value) list_->setCurrentRow(i);
}

/// The symbol's middle comes to where it was dropped.
void SymbolsWidget::takeDrop(const ui::DroppedOnScene& drop)
{
    if (!drop.data.starts_with(kDrag) || drop.scene != scene_ || scene_->items().inTransaction()) return;
    const Item* symbol =
        scene_->items().find(ItemId{QByteArray::fromStdString(drop.data.substr(kDrag.size())).toULongLong()});
    if (!symbol || !isSymbol(*symbol)) return;
    try {
        auto edit = scene_->items().begin("Place symbol");
        const Item& instance = placeSymbol(edit, *symbol, placeFor(editor_, *scene_),
                                           Affine::translation(drop.at - symbol->bounds().center()));
        edit.select(instance);
        edit.commit();
    } catch (const std::exception& problem) {
        editor_.showMessage(problem.what());
    }
}

void SymbolsWidget::place()
{
    const Item& symbol = *current();
    const auto others = instancesOf(*scene_, symbol);
    Affine placement = others.empty() ? Affine() : placementOf(*others.back());
    if (!others.empty()) placement = Affine::translation({kAside, kAside}) * placement;
    auto edit = scene_->items().begin("Place symbol");
    const Item& instance = placeSymbol(edit, symbol, placeFor(editor_, *scene_), placement);
    edit.select(instance);
    edit.commit();
}

void SymbolsWidget::edit()
{
    if (instancesOf(*scene_, *current()).empty()) place();
    const auto instances = instancesOf(*scene_, *current());
    const Item& first = *instances.front();
    std::vector<ItemId> members;
    for (const auto& child : first.children()) members.push_back(child->id());
    scene_->items().setSelection(std::move(members));
    editor_.events().post(&editor_, ShowArea{scene_, first.bounds()});
    editor_.showStatus(
        tr("What is changed here changes in %n instance(s).", nullptr, static_cast<int>(instances.size()))
            .toStdString());
}

void SymbolsWidget::selectInstances()
{
    std::vector<ItemId> ids;
    for (const Item* instance : instancesOf(*scene_, *current()))
        if (!holderOf(*instance)) ids.push_back(instance->id());
    scene_->items().setSelection(std::move(ids));
}

void SymbolsWidget::detach()
{
    auto edit = scene_->items().begin("Detach instance");
    bool any = false;
    for (const Item* item : topSelection(*scene_)) {
        if (linkOf(*item) != current()->id()) continue;
        detachInstance(edit, *item);
        any = true;
    }
    if (!any) return editor_.showMessage(tr("Select instances of this symbol in the scene first.").toStdString());
    edit.commit();
}

void SymbolsWidget::rename() { list_->editItem(list_->currentItem()); }

void SymbolsWidget::giveName(const QListWidgetItem& row)
{
    const Item* symbol = scene_ ? scene_->items().find(ItemId{row.data(kIdRole).toULongLong()}) : nullptr;
    const std::string name = row.text().trimmed().toStdString();
    // Later: the list is in the middle of closing its line of text.
    QMetaObject::invokeMethod(this, &SymbolsWidget::rebuild, Qt::QueuedConnection);
    if (!symbol || name.empty() || name == symbol->name() || scene_->items().inTransaction()) return;
    if (findSymbol(*scene_, name))
        return editor_.showMessage(
            tr("There is a symbol called “%1” already; choose another name.").arg(row.text().trimmed()).toStdString());
    auto edit = scene_->items().begin("Rename symbol");
    edit.set(*symbol, "name", name);
    edit.commit();
}

void SymbolsWidget::remove()
{
    auto edit = scene_->items().begin("Delete symbol");
    removeSymbol(edit, *current());
    edit.commit();
}

}  // namespace jet::symbol_list
