#include "find_widget.hpp"

#include <jet/arrange.hpp>
#include <jet/ui/icons.hpp>

#include <QHBoxLayout>
#include <QKeyEvent>
#include <QToolButton>
#include <QVBoxLayout>

namespace jet::find {

namespace {

constexpr int kLowest = 48;  // pixels: two rows

}  // namespace

FindWidget::FindWidget(Editor& editor)
    : editor_(editor), model_(this), line_(new QLineEdit(this)), note_(new QLabel(this)), list_(new QListView(this))
{
    line_->setObjectName("find-query");
    line_->setPlaceholderText(tr("ball type:shape mass>2"));
    line_->setToolTip(
        tr("Words are looked for in names. Also: name:ball*  type:shape  mass>2  fixed=true  effect:stroke  "
           "layer:front  symbol:wheel  is:hidden  -type:group"));
    line_->setClearButtonEnabled(true);
    line_->setAccessibleName(tr("Find"));
    line_->installEventFilter(this);
    note_->setObjectName("find-note");
    note_->setWordWrap(true);
    note_->setContentsMargins(6, 2, 6, 2);
    list_->setObjectName("find-results");
    list_->setModel(&model_);
    list_->setUniformItemSizes(true);  // a hundred thousand rows are laid out at once
    list_->setAccessibleName(tr("Items found"));
    // It scrolls by itself, however low the panel is; its wish for height would make the panel scroll around it.
    list_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Ignored);
    list_->setMinimumHeight(kLowest);
    setFocusProxy(line_);

    auto* bar = new QHBoxLayout;
    bar->setContentsMargins(4, 4, 4, 2);
    bar->setSpacing(2);
    bar->addWidget(line_);
    const auto addButton = [&](const char* icon, const QString& text, auto run) {
        auto* button = new QToolButton(this);
        button->setAutoRaise(true);
        button->setIcon(ui::icon(icon));
        button->setToolTip(text);
        connect(button, &QToolButton::clicked, this, run);
        bar->addWidget(button);
    };
    addButton("up", tr("Previous (Shift+Enter)"), [this] { step(-1); });
    addButton("down", tr("Next (Enter)"), [this] { step(1); });
    addButton("frame", tr("Select all found (Ctrl+Enter)"), [this] { selectAll(); });
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addLayout(bar);
    layout->addWidget(note_);
    layout->addWidget(list_, 1);

    connect(line_, &QLineEdit::textChanged, this, &FindWidget::readQuery);
    connect(list_, &QListView::clicked, this, &FindWidget::goTo);
    connect(list_, &QListView::activated, this, &FindWidget::goTo);
    front_ = editor.events().subscribe<ActiveSceneChanged>(
        nullptr, [this](const ActiveSceneChanged& event) { watch(event.scene); });
    watch(editor.activeScene());
}

void FindWidget::focusInEvent(QFocusEvent* event)
{
    QWidget::focusInEvent(event);
    line_->selectAll();
}

bool FindWidget::eventFilter(QObject* object, QEvent* event)
{
    if (object != line_ || event->type() != QEvent::KeyPress) return QWidget::eventFilter(object, event);
    const auto* key = static_cast<QKeyEvent*>(event);
    if (key->key() == Qt::Key_Down && key->modifiers() == Qt::NoModifier) {
        list_->setFocus();
        step(1);
        return true;
    }
    if (key->key() != Qt::Key_Return && key->key() != Qt::Key_Enter) return QWidget::eventFilter(object, event);
    if (key->modifiers() & Qt::ControlModifier) {
        selectAll();
    } else {
        step(key->modifiers() & Qt::ShiftModifier ? -1 : 1);
    }
    return true;
}

void FindWidget::watch(Scene* scene)
{
    scene_ = scene;
    changed_.reset();
    if (scene)
        changed_ =
            editor_.events().subscribeCoalesced<ItemsChanged>(scene, [this](const ItemsChanged::Burst&) { search(); });
    search();
}

void FindWidget::readQuery()
{
    problem_.clear();
    query_ = FindQuery();
    if (auto query = FindQuery::parse(line_->text().toStdString())) {
        query_ = std::move(*query);
    } else {
        problem_ = tr("Column %1: ").arg(query.error().where.column).toStdString() + query.error().message;
    }
    search();
}

void FindWidget::search()
{
    const Item* present = model_.itemAt(list_->currentIndex().row());
    const ItemId kept = present ? present->id() : ItemId{};
    std::vector<ItemId> ids;
    if (scene_ && problem_.empty())
        for (const Item* item : findItems(*scene_, query_)) ids.push_back(item->id());
    const auto place = std::find(ids.begin(), ids.end(), kept);
    const int row = place == ids.end() ? -1 : static_cast<int>(place - ids.begin());
    model_.show(scene_, std::move(ids));
    if (row >= 0) list_->setCurrentIndex(model_.index(row));
    tell();
}

void FindWidget::tell()
{
    const auto count = static_cast<int>(model_.found().size());
    const QString found = query_.isEmpty() ? QString() : tr("%n found", nullptr, count);
    note_->setText(problem_.empty() ? found : QString::fromStdString(problem_));
    note_->setVisible(!note_->text().isEmpty());
}

void FindWidget::step(int by)
{
    const int count = model_.rowCount();
    if (count == 0) return;
    const int present = list_->currentIndex().row();
    const int row = present < 0 ? (by > 0 ? 0 : count - 1) : (present + by + count) % count;
    goTo(model_.index(row));
}

void FindWidget::goTo(const QModelIndex& index)
{
    const Item* item = model_.itemAt(index.row());
    if (!item || scene_->items().inTransaction()) return;
    list_->setCurrentIndex(index);
    const Box area = item->bounds();
    scene_->items().setSelection({item->id()});
    if (!area.isNull()) editor_.events().post(&editor_, ShowArea{scene_, area});
}

void FindWidget::selectAll()
{
    if (!scene_ || scene_->items().inTransaction()) return;
    scene_->items().setSelection(model_.found());
    editor_.showStatus(tr("%n items selected", nullptr, model_.rowCount()).toStdString());
}

}  // namespace jet::find
