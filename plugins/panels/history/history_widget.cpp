#include "history_widget.hpp"

#include <QCoreApplication>
#include <QLocale>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include <algorithm>
#include <utility>

namespace jet::history {

namespace {

constexpr int kSceneTab = 0, kProjectTab = 1;

QString translated(const char* text) { return QCoreApplication::translate("History", text); }

QString textOf(const std::string& text) { return QString::fromStdString(text); }

}  // namespace

HistoryWidget::HistoryWidget(Editor& editor)
    : editor_(editor), model_(this), tabs_(new QTabBar(this)), list_(new QListView(this)), next_(new QLabel(this)),
      memory_(new QLabel(this)), focus_([this] { followSoon(); })
{
    tabs_->setObjectName("history-tabs");
    tabs_->setAccessibleName(translated("Which history"));
    tabs_->addTab(translated("Scene"));
    tabs_->addTab(translated("Project"));
    tabs_->setDocumentMode(true);
    tabs_->setExpanding(true);
    tabs_->setElideMode(Qt::ElideRight);
    tabs_->setTabToolTip(kProjectTab, translated("Scenes and files that were added, removed, moved and renamed"));
    list_->setObjectName("history-list");
    list_->setModel(&model_);
    list_->setUniformItemSizes(true);  // ten thousand steps are laid out at once
    list_->setSelectionMode(QAbstractItemView::SingleSelection);
    list_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    list_->setAccessibleName(translated("History"));
    setFocusProxy(list_);
    for (QLabel* label : {next_, memory_}) {
        label->setContentsMargins(6, 2, 6, 3);
        label->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);  // a long name does not widen the panel
    }
    next_->setObjectName("history-next");
    memory_->setObjectName("history-memory");
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    for (QWidget* part : {static_cast<QWidget*>(tabs_), static_cast<QWidget*>(list_), static_cast<QWidget*>(next_),
                          static_cast<QWidget*>(memory_)})
        layout->addWidget(part);
    connect(tabs_, &QTabBar::currentChanged, this, [this](int tab) {
        choose(tab);
        list_->setFocus();  // so that Undo works on what is shown
    });
    connect(list_, &QListView::clicked, this, [this](const QModelIndex& index) { goTo(index); });
    connect(list_, &QListView::activated, this, [this](const QModelIndex& index) { goTo(index); });
    EventsCenter& events = editor.events();
    subscriptions_.push_back(
        events.subscribe<ActiveSceneChanged>(nullptr, [this](const ActiveSceneChanged&) { frontChanged(); }));
    subscriptions_.push_back(
        events.subscribe<ProjectChanged>(nullptr, [this](const ProjectChanged&) { frontChanged(); }));
    subscriptions_.push_back(events.subscribe<ProjectTreeChanged>(nullptr, [this](const ProjectTreeChanged&) {
        if (model_.scene() && !isPresent(model_.scene())) return choose(kSceneTab);
        refresh();  // a scene may have another name
    }));
    subscriptions_.push_back(events.subscribe<SimulationStateChanged>(
        nullptr, [this](const SimulationStateChanged&) { showNext(tabs_->currentIndex() == kProjectTab); }));
    choose(kSceneTab);
    follow();
}

bool HistoryWidget::isPresent(const Scene* scene) const
{
    return std::ranges::count(editor_.project().scenes(), scene) > 0;
}

// Later: where a tab closes or opens the focus goes elsewhere for a moment, and comes back.
void HistoryWidget::followSoon()
{
    if (std::exchange(follows_, true)) return;
    QMetaObject::invokeMethod(
        this, [this] { follow(); }, Qt::QueuedConnection);
}

void HistoryWidget::follow()
{
    follows_ = false;
    const bool isOther = std::exchange(otherFront_, false);
    const bool isHere = list_->hasFocus() || tabs_->hasFocus();
    const auto focus = focus_.now();
    if (focus && !focus->scene) return work(*focus);
    if (focus && isPresent(focus->scene) && !(isHere && isOther)) return work(*focus);
    choose(kSceneTab);
}

void HistoryWidget::frontChanged()
{
    if (model_.scene() && !isPresent(model_.scene())) {
        changed_.reset();
        model_.show(nullptr);
    }
    if (tabs_->currentIndex() == kProjectTab) model_.show(editor_.projectTree());  // perhaps that of another project
    otherFront_ = true;
    followSoon();
}

void HistoryWidget::choose(int tab)
{
    Scene* front = editor_.activeScene();
    if (tab == kProjectTab || front) return work({tab == kProjectTab ? nullptr : front});
    changed_.reset();
    model_.show(nullptr);
    refresh();
}

void HistoryWidget::work(ui::HistoryFocus history)
{
    changed_.reset();
    if (history.scene) {
        model_.show(history.scene);
        changed_ = editor_.events().subscribeCoalesced<HistoryChanged>(history.scene,
                                                                       [this](const HistoryChanged&) { refresh(); });
    } else {
        model_.show(editor_.projectTree());
    }
    refresh();
    if (ui::historyFocus(this) != std::optional(history)) ui::setHistoryFocus(*this, history);
}

void HistoryWidget::refresh()
{
    model_.refresh();
    const QModelIndex now = model_.index(model_.currentRow());
    list_->setCurrentIndex(now);
    list_->scrollTo(now);
    const Scene* scene = model_.scene();
    const Scene* named = scene ? scene : editor_.activeScene();
    const bool isProject = !scene && model_.currentRow() >= 0;
    const QSignalBlocker blocker(tabs_);
    tabs_->setCurrentIndex(isProject ? kProjectTab : kSceneTab);
    tabs_->setTabText(kSceneTab, named ? textOf(named->name()).replace('&', "&&") : translated("Scene"));
    tabs_->setTabToolTip(kSceneTab,
                         named ? translated("What was done in the scene %1").arg(textOf(named->name())) : QString());
    showNext(isProject);
    memory_->setVisible(scene != nullptr);
    if (!scene) return;
    const UndoRedoCenter& history = scene->undoRedo();
    const QLocale locale;
    memory_->setText(translated("%1 of %2 used")
                         .arg(locale.formattedDataSize(static_cast<qint64>(history.memory()), 1),
                              locale.formattedDataSize(static_cast<qint64>(history.memoryLimit()), 0)));
}

void HistoryWidget::showNext(bool isProject)
{
    const Scene* scene = model_.scene();
    const SimulationCenter& play = editor_.simulation();
    const bool isPlaying = scene && play.state() != SimulationCenter::State::Stopped && play.scene() == scene;
    const QString step = model_.undoLabel();
    next_->setVisible(model_.currentRow() >= 0);
    if (isPlaying) {
        next_->setText(translated("Stop the game to undo"));
    } else {
        next_->setText(step.isEmpty() ? translated("Nothing to undo here")
                                      : translated("Undo takes back: %1").arg(step));
    }
    next_->setToolTip(isProject ? translated("Undo works on the project now.")
                                : translated("Undo works on this scene now."));
}

void HistoryWidget::goTo(const QModelIndex& index)
{
    if (!index.isValid() || index.row() == model_.currentRow()) return;
    try {
        model_.goTo(index.row());
    } catch (const std::exception& problem) {
        editor_.showMessage(problem.what());  // a drag is going on in the scene
    }
    refresh();
}

}  // namespace jet::history
