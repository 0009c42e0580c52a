#include "window/main_window.hpp"

#include <jet/ui/icons.hpp>

#include <QApplication>
#include <QCloseEvent>
#include <QCoreApplication>
#include <QLabel>
#include <QMenuBar>
#include <QPointer>
#include <QProgressDialog>
#include <QSettings>
#include <QStatusBar>
#include <QTimer>
#include <QToolBar>
#include <QVBoxLayout>

#include <algorithm>

namespace jet::host {

namespace {

constexpr MenuSpec kMenus[] = {
    {QT_TRANSLATE_NOOP("Actions", "&File"),
     "file.new file.open @recent | file.save file.save-as file.collect file.export-single file.recover | "
     "file.import file.export | view.close file.quit"},
    {QT_TRANSLATE_NOOP("Actions", "&Edit"),
     "edit.undo edit.redo | edit.cut edit.copy edit.paste edit.paste-in-place edit.duplicate "
     "edit.delete | edit.select-all edit.group edit.ungroup | edit.settings"},
    {QT_TRANSLATE_NOOP("Actions", "&Scene"), "scene.new @scenes | @effects"},
    {QT_TRANSLATE_NOOP("Actions", "&View"), "view.zoom-in view.zoom-out view.zoom-reset view.frame | view.grid | "
                                            "@panels view.maximize view.reset-layout | plugins.reload"},
    {QT_TRANSLATE_NOOP("Actions", "&Play"), "play.play play.pause play.step play.stop"},
};
constexpr const char* kMainBar = "file.new file.open file.save | edit.undo edit.redo | play.play play.pause play.step "
                                 "play.stop | view.frame view.grid";
constexpr const char* kContextMenu = "edit.undo edit.redo | edit.cut edit.copy edit.paste edit.duplicate edit.delete | "
                                     "edit.group edit.ungroup | @effects | view.frame";

constexpr int kProblemsMs = 1000;

QSettings settings() { return QSettings(QSettings::IniFormat, QSettings::UserScope, "jet", "window"); }

QString number(double value, int decimals) { return QString::number(value, 'f', decimals); }

}  // namespace

MainWindow::MainWindow(const WindowLaunch& launch)
    : catalog_(launch.catalog), noPlugins_(launch.catalog), plugins_(launch.plugins ? *launch.plugins : noPlugins_),
      events_(launch.events), safeMode_(launch.safeMode), pluginProblems_(launch.pluginProblems),
      runtime_(launch.runtime), setReloader_(launch.setReloader), pump_(launch.events), simulation_(launch.events),
      messages_(new MessageBar(nullptr)), documents_(new Documents(*this, toolOptions_, nullptr)),
      actions_(this, [this](const std::exception& problem) { showMessage(problem.what()); }),
      projects_(*this, *documents_, this), pluginController_(*this, projects_, *messages_, this),
      formats_(*this, *documents_, this), edits_(*this, *documents_, this), commands_(*this, *documents_, this),
      player_(*this, *documents_, this), sounds_(*this, this), tools_(*this, *documents_, toolOptions_, this),
      docks_(*this, *this), reloader_(*this, *documents_, tools_, docks_, launch.runtime, this),
      views_(*documents_, docks_, this)
{
    pluginController_.setUseProjectPlugins(launch.useProjectPlugins);
    pluginController_.setFrozen(launch.frozen);
    if (setReloader_) setReloader_([this](const std::string& plugin) { return reloader_.request(plugin); });
    setDockOptions(AnimatedDocks | AllowNestedDocks | AllowTabbedDocks | GroupedDragging);
    setTabPosition(Qt::AllDockWidgetAreas, QTabWidget::North);
    setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
    setCentralWidget(createCentral());
    resize(1360, 860);
    createActions();
    createMenus();
    createToolBars();
    createStatusBar();
    connectDocuments();
    followEvents();
    reloader_.watch(launch.watch);
}

MainWindow::~MainWindow()
{
    if (setReloader_) setReloader_({});
    simulation_.stop();
    subscriptions_.clear();
    projects_.close();  // views and script tabs refer to scenes
}

QWidget* MainWindow::createCentral()
{
    auto* central = new QWidget(this);
    auto* layout = new QVBoxLayout(central);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(messages_);
    layout->addWidget(documents_, 1);
    return central;
}

// --- menus and bars

void MainWindow::createActions()
{
    const auto newScene = [this] { openScene(projectTree().addScene(project().freeSceneName(), project().root())); };
    actions_.add(projects_.actions());
    actions_.add(pluginController_.actions());
    actions_.add(formats_.actions());
    actions_.add(edits_.actions());
    actions_.add(player_.actions());
    actions_.add(views_.actions());
    views_.follow(*this);
    actions_.add(reloader_.actions());
    actions_.add({
        {"scene.new", QT_TRANSLATE_NOOP("Actions", "&New scene"), "plus", "", newScene},
        {"file.quit", QT_TRANSLATE_NOOP("Actions", "&Quit"), "", "Ctrl+Q", [this] { close(); }},
    });
    actions_.addSubmenu("recent", {QT_TRANSLATE_NOOP("Actions", "&Recent projects"), "",
                                   [this](QMenu& menu) { projects_.fillRecentMenu(menu); }});
    actions_.addSubmenu("effects", {QT_TRANSLATE_NOOP("Actions", "&Apply effect"), "effect",
                                    [this](QMenu& menu) { edits_.fillEffectsMenu(menu); }});
    actions_.addSubmenu("panels",
                        {QT_TRANSLATE_NOOP("Actions", "&Panels"), "", [this](QMenu& menu) { docks_.fillMenu(menu); }});
    actions_.addSubmenu("scenes", {QT_TRANSLATE_NOOP("Actions", "&Open scene"), "scene", [this](QMenu& menu) {
                                       for (Scene* scene : project().scenes()) {
                                           menu.addAction(ui::icon("scene"), QString::fromStdString(scene->name()),
                                                          this, [this, scene] { openScene(*scene); });
                                       }
                                   }});
}

void MainWindow::createMenus()
{
    actions_.buildMenuBar(*menuBar(), kMenus);
    commands_.build(*menuBar());
}

void MainWindow::followPlugins()
{
    tools_.rebuild();
    commands_.build(*menuBar());
    docks_.rebuild();
    for (SceneView* view : documents_->views()) view->invalidate();
    actions_.refreshSoon();
}

void MainWindow::createToolBars()
{
    const auto bar = [this](const QString& title, const char* name, Qt::ToolBarArea area) {
        auto* made = new QToolBar(title, this);
        made->setObjectName(QLatin1String(name));
        made->setIconSize(QSize(20, 20));
        addToolBar(area, made);
        return made;
    };
    actions_.buildToolBar(*bar(tr("Main"), "mainBar", Qt::TopToolBarArea), kMainBar);
    QToolBar* options = bar(tr("Tool options"), "toolOptionsBar", Qt::TopToolBarArea);
    tools_.setOptionsBar(*options);
    tools_.buildToolBar(*bar(tr("Tools"), "toolsBar", Qt::LeftToolBarArea));
}

void MainWindow::createStatusBar()
{
    status_ = new QLabel(this);
    pointer_ = new QLabel(this);
    zoom_ = new QLabel(this);
    pointer_->setMinimumWidth(150);
    zoom_->setMinimumWidth(64);
    statusBar()->addWidget(status_, 1);
    statusBar()->addPermanentWidget(pointer_);
    statusBar()->addPermanentWidget(zoom_);
}

// --- keeping up

void MainWindow::connectDocuments()
{
    connect(documents_, &Documents::frontChanged, this, &MainWindow::frontChanged);
    connect(documents_, &Documents::viewOpened, this, [this](SceneView* view) { prepareView(*view); });
    connect(&projects_, &ProjectController::saved, this, &MainWindow::updateTitle);
    connect(&edits_, &EditController::historyChanged, &actions_, &Actions::refreshSoon);
    connect(&pluginController_, &PluginController::changed, this, &MainWindow::followPlugins);
}

void MainWindow::prepareView(SceneView& view)
{
    views_.prepare(view);
    connect(&view, &SceneView::pointerMoved, this, &MainWindow::showPointer);
    connect(&view, &SceneView::pointerLeft, pointer_, &QLabel::clear);
    connect(&view, &SceneView::viewChanged, this, &MainWindow::updateZoom);
    connect(&view, &SceneView::keyUnused, this, [this](QKeyEvent* event) { useKey(*event); });
    connect(&view, &SceneView::filesDropped, &formats_, &FormatController::importFiles);
    connect(&view, &SceneView::contextMenuRequested, this, [this](const QPoint& at) {
        QMenu menu(this);
        actions_.refresh();
        actions_.fillMenu(menu, kContextMenu);
        menu.exec(at);
    });
}

void MainWindow::followEvents()
{
    const auto refresh = [this](const auto&) { actions_.refreshSoon(); };
    const auto changed = [this](const ItemsChanged&) {
        actions_.refreshSoon();
        updateTitle();
    };
    const auto projectChanged = [this](const ProjectChanged&) {
        activeLayers_.clear();
        closedByTree_.clear();
        actions_.refreshSoon();
        updateTitle();
    };
    subscriptions_.push_back(events_.subscribe<ItemsChanged>(nullptr, changed));
    subscriptions_.push_back(events_.subscribe<ProjectChanged>(nullptr, projectChanged));
    subscriptions_.push_back(
        events_.subscribe<ProjectTreeChanged>(nullptr, [this](const ProjectTreeChanged&) { followTree(); }));
    subscriptions_.push_back(events_.subscribe<SelectionChanged>(nullptr, refresh));
    subscriptions_.push_back(events_.subscribe<SimulationStateChanged>(nullptr, refresh));
    // A plugin may fail at any time, on any thread: asking now and then costs less than another way in.
    auto* problems = new QTimer(this);
    connect(problems, &QTimer::timeout, this, &MainWindow::showPluginProblems);
    problems->start(kProblemsMs);
    showPluginProblems();
}

void MainWindow::showPluginProblems()
{
    if (!pluginProblems_) return;
    if (runtime_) docks_.showFailures(*runtime_);
    for (std::string& problem : pluginProblems_()) {
        if (shownProblems_.insert(problem).second) showMessage(std::move(problem));
    }
}

void MainWindow::frontChanged()
{
    tools_.applyToFront();
    updateZoom();
    actions_.refreshSoon();
    Scene* front = documents_->currentScene();
    if (front == frontScene_) return;
    frontScene_ = front;
    events_.post(static_cast<Editor*>(this), ActiveSceneChanged{front});
}

void MainWindow::followTree()
{
    const std::vector<Scene*> all = project().scenes();
    const QPointer<QWidget> focus = QApplication::focusWidget();
    const auto isThere = [&](const Scene* scene) { return std::find(all.begin(), all.end(), scene) != all.end(); };
    if (simulation_.state() != SimulationCenter::State::Stopped && !isThere(simulation_.scene())) simulation_.stop();
    for (const Scene* scene : documents_->scenes()) {
        if (isThere(scene)) continue;
        documents_->closeScene(*scene);
        closedByTree_.push_back(scene);
    }
    for (Scene* scene : all)
        if (std::erase(closedByTree_, scene) > 0) documents_->openScene(*scene);
    if (focus && focus->isVisible()) focus->setFocus();  // tabs that close and open took it from a panel
    actions_.refreshSoon();
    updateTitle();
}

void MainWindow::useKey(QKeyEvent& event)
{
    if (event.key() == Qt::Key_Escape) return tools_.escape();
    if (edits_.nudge(event.key(), event.modifiers().testFlag(Qt::ShiftModifier))) return;
    const QKeySequence keys(event.keyCombination());
    if (!tools_.trigger(keys) && !actions_.trigger(keys)) event.ignore();
}

void MainWindow::updateTitle()
{
    documents_->updateTitles();
    const QString mode = safeMode_ ? tr(" (safe mode)") : QString();
    setWindowTitle(QStringLiteral("%1[*] — JET%2").arg(QString::fromStdString(project().name()), mode));
    setWindowModified(projects_.isModified());
}

void MainWindow::updateZoom()
{
    const SceneView* view = documents_->currentView();
    zoom_->setText(view ? number(100 * view->camera().view().scale, 0) + QLatin1Char('%') : QString());
}

void MainWindow::showPointer(const QPointF& scene)
{
    pointer_->setText(QStringLiteral("x %1   y %2").arg(number(scene.x(), 1), number(scene.y(), 1)));
}

// --- Editor

void MainWindow::openScene(Scene& scene) { documents_->openScene(scene); }

void MainWindow::openScript(Scene& scene, ItemId script, int line)
{
    if (scene.items().find(script)) documents_->openScript(scene, script, line);
}

void MainWindow::print(OutputLine line) { events_.post(static_cast<Editor*>(this), OutputPrinted{std::move(line)}); }
void MainWindow::showMessage(std::string text) { messages_->add(QString::fromStdString(text)); }

Progress MainWindow::progress(const std::string& label)
{
    constexpr int kSteps = 1000;
    const auto dialog = std::make_shared<QProgressDialog>(QString::fromStdString(label), tr("Cancel"), 0, kSteps, this);
    dialog->setWindowModality(Qt::WindowModal);  // setValue() then handles events, so that Cancel can be pressed
    dialog->setMinimumDuration(500);
    return Progress{[dialog](double done) {
        dialog->setValue(static_cast<int>(std::clamp(done, 0.0, 1.0) * kSteps));
        return !dialog->wasCanceled();
    }};
}

void MainWindow::showStatus(std::string text) { status_->setText(QString::fromStdString(text)); }

ItemId MainWindow::activeLayer() const
{
    const auto found = activeLayers_.find(documents_->currentScene());
    return found != activeLayers_.end() ? found->second : ItemId{};
}

void MainWindow::setActiveLayer(ItemId layer)
{
    if (const Scene* scene = documents_->currentScene()) activeLayers_[scene] = layer;
}

// --- start and end

void MainWindow::restoreSettings()
{
    QSettings stored = settings();
    tools_.restoreOptions(stored);
    projects_.restoreRecent(stored);
    views_.restore(stored);
    docks_.createDocks();
    docks_.restoreLayout(stored);
}

void MainWindow::saveSettings()
{
    QSettings stored = settings();
    tools_.saveOptions(stored);
    projects_.saveRecent(stored);
    views_.save(stored);
    docks_.saveLayout(stored);
}

void MainWindow::closeEvent(QCloseEvent* event)
{
    if (!projects_.mayClose()) return event->ignore();
    player_.stop();
    saveSettings();
    event->accept();
}

}  // namespace jet::host
