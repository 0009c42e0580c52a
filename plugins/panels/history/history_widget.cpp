#include "history_widget.hpp"

#include <QCoreApplication>
#include <QLocale>
#include <QVBoxLayout>

namespace jet::history {

namespace {

QString translated(const char* text) { return QCoreApplication::translate("History", text); }

}  // namespace

HistoryWidget::HistoryWidget(Editor& editor)
    : editor_(editor), model_(this), list_(new QListView(this)), memory_(new QLabel(this))
{
    list_->setObjectName("history-list");
    list_->setModel(&model_);
    list_->setUniformItemSizes(true);  // ten thousand steps are laid out at once
    list_->setSelectionMode(QAbstractItemView::SingleSelection);
    list_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    list_->setAccessibleName(translated("History"));
    memory_->setObjectName("history-memory");
    memory_->setContentsMargins(6, 2, 6, 3);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(list_);
    layout->addWidget(memory_);
    connect(list_, &QListView::clicked, this, [this](const QModelIndex& index) { goTo(index); });
    connect(list_, &QListView::activated, this, [this](const QModelIndex& index) { goTo(index); });
    front_ = editor.events().subscribe<ActiveSceneChanged>(
        nullptr, [this](const ActiveSceneChanged& event) { watch(event.scene); });
    watch(editor.activeScene());
}

void HistoryWidget::watch(Scene* scene)
{
    changed_.reset();
    model_.setScene(scene);
    if (scene) {
        changed_ =
            editor_.events().subscribeCoalesced<HistoryChanged>(scene, [this](const HistoryChanged&) { refresh(); });
    }
    refresh();
}

void HistoryWidget::refresh()
{
    model_.refresh();
    const QModelIndex now = model_.index(model_.currentRow());
    list_->setCurrentIndex(now);
    list_->scrollTo(now);
    const Scene* scene = model_.scene();
    memory_->setVisible(scene != nullptr);
    if (!scene) return;
    const UndoRedoCenter& history = scene->undoRedo();
    const QLocale locale;
    memory_->setText(translated("%1 of %2 used")
                         .arg(locale.formattedDataSize(static_cast<qint64>(history.memory()), 1),
                              locale.formattedDataSize(static_cast<qint64>(history.memoryLimit()), 0)));
}

void HistoryWidget::goTo(const QModelIndex& index)
{
    Scene* scene = model_.scene();
    if (!scene || !index.isValid() || index.row() == model_.currentRow()) return;
    try {
        scene->undoRedo().goTo(static_cast<std::size_t>(index.row()));
    } catch (const std::exception& problem) {
        editor_.showMessage(problem.what());  // a drag is going on in the scene
    }
    refresh();
}

}  // namespace jet::history
