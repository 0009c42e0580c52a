#include "physics_widget.hpp"

#include <jet/rewind.hpp>

#include <QCheckBox>
#include <QCoreApplication>
#include <QGridLayout>
#include <QGroupBox>
#include <QHeaderView>
#include <QLabel>
#include <QLocale>
#include <QSignalBlocker>
#include <QSlider>
#include <QTableWidget>
#include <QTimer>

namespace jet::panels {

namespace {

QString translated(const char* text) { return QCoreApplication::translate("PhysicsWidget", text); }

constexpr int kRefreshMs = 100;  // numbers that change more often cannot be read

struct MarkRow {
    bool PhysicsMarks::*mark;
    const char* name;
    const char* label;
    const char* help;
};

const MarkRow kMarks[] = {
    {&PhysicsMarks::contacts, "contacts", QT_TRANSLATE_NOOP("PhysicsWidget", "Contacts"),
     QT_TRANSLATE_NOOP("PhysicsWidget", "Touching points with their normals; the orange part grows with the impulse")},
    {&PhysicsMarks::islands, "islands", QT_TRANSLATE_NOOP("PhysicsWidget", "Islands"),
     QT_TRANSLATE_NOOP("PhysicsWidget", "Bodies that touch or are joined in one colour; sleeping ones are grey")},
    {&PhysicsMarks::stress, "stress", QT_TRANSLATE_NOOP("PhysicsWidget", "Stress"),
     QT_TRANSLATE_NOOP("PhysicsWidget", "Springs of soft bodies: blue where pressed, red where stretched")},
    {&PhysicsMarks::boxes, "boxes", QT_TRANSLATE_NOOP("PhysicsWidget", "Bounding boxes"),
     QT_TRANSLATE_NOOP("PhysicsWidget", "Of each body")},
    {&PhysicsMarks::centres, "centres", QT_TRANSLATE_NOOP("PhysicsWidget", "Centres of mass"),
     QT_TRANSLATE_NOOP("PhysicsWidget", "With an axis that turns with the body")},
    {&PhysicsMarks::joints, "joints", QT_TRANSLATE_NOOP("PhysicsWidget", "Joints"),
     QT_TRANSLATE_NOOP("PhysicsWidget", "Where they hold; broken ones are crossed out")},
};

struct NumberRow {
    const char* label;
    QString (*text)(const PhysicsPicture&);
};

QString count(std::uint32_t value) { return QLocale().toString(value); }
QString milliseconds(double value) { return QLocale().toString(value, 'f', 3); }

const NumberRow kNumbers[] = {
    {QT_TRANSLATE_NOOP("PhysicsWidget", "Bodies"),
     [](const PhysicsPicture& p) { return count(static_cast<std::uint32_t>(p.bodies.size())); }},
    {QT_TRANSLATE_NOOP("PhysicsWidget", "Bodies computed"),
     [](const PhysicsPicture& p) { return count(p.stats.awakeBodies); }},
    {QT_TRANSLATE_NOOP("PhysicsWidget", "Contacts"), [](const PhysicsPicture& p) { return count(p.stats.contacts); }},
    {QT_TRANSLATE_NOOP("PhysicsWidget", "Pairs of boxes"),
     [](const PhysicsPicture& p) { return count(p.stats.pairs); }},
    {QT_TRANSLATE_NOOP("PhysicsWidget", "Islands"), [](const PhysicsPicture& p) { return count(p.stats.islands); }},
    {QT_TRANSLATE_NOOP("PhysicsWidget", "Colours of contacts"),
     [](const PhysicsPicture& p) { return count(p.stats.colours); }},
    {QT_TRANSLATE_NOOP("PhysicsWidget", "Substeps"), [](const PhysicsPicture& p) { return count(p.stats.substeps); }},
    {QT_TRANSLATE_NOOP("PhysicsWidget", "Memory, kB"),
     [](const PhysicsPicture& p) { return count(static_cast<std::uint32_t>(p.stats.memory / 1024)); }},
    {QT_TRANSLATE_NOOP("PhysicsWidget", "Step, ms"), [](const PhysicsPicture& p) { return milliseconds(p.stepMs); }},
    {QT_TRANSLATE_NOOP("PhysicsWidget", "Broad phase, ms"),
     [](const PhysicsPicture& p) { return milliseconds(p.stats.broadPhaseMs); }},
    {QT_TRANSLATE_NOOP("PhysicsWidget", "Narrow phase, ms"),
     [](const PhysicsPicture& p) { return milliseconds(p.stats.narrowPhaseMs); }},
    {QT_TRANSLATE_NOOP("PhysicsWidget", "Islands, ms"),
     [](const PhysicsPicture& p) { return milliseconds(p.stats.islandsMs); }},
    {QT_TRANSLATE_NOOP("PhysicsWidget", "Solver, ms"),
     [](const PhysicsPicture& p) { return milliseconds(p.stats.solverMs); }},
    {QT_TRANSLATE_NOOP("PhysicsWidget", "Springs, ms"),
     [](const PhysicsPicture& p) { return milliseconds(p.stats.springsMs); }},
    {QT_TRANSLATE_NOOP("PhysicsWidget", "Continuous, ms"),
     [](const PhysicsPicture& p) { return milliseconds(p.stats.continuousMs); }},
};

}  // namespace

PhysicsMarks allMarks() { return {true, true, true, true, true, true, false}; }

PhysicsWidget::PhysicsWidget(Editor& editor, QWidget* parent)
    : QWidget(parent), editor_(editor), timer_(new QTimer(this))
{
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(createMarks());
    layout->addWidget(createRewind());
    layout->addWidget(createTable(), 1);
    timer_->setSingleShot(true);
    connect(timer_, &QTimer::timeout, this, &PhysicsWidget::refresh);
    const auto soon = [this] {
        if (isVisible() && !timer_->isActive()) timer_->start(kRefreshMs);
    };
    frames_ = editor.events().subscribe<SimulationFrameReady>(nullptr, [soon](const SimulationFrameReady&) { soon(); });
    states_ =
        editor.events().subscribe<SimulationStateChanged>(nullptr, [soon](const SimulationStateChanged&) { soon(); });
    marks_ =
        editor.events().subscribe<PhysicsMarksChanged>(nullptr, [this](const PhysicsMarksChanged&) { showMarks(); });
    showMarks();
    refresh();
}

PhysicsWidget::~PhysicsWidget()
{
    if (isVisible()) changeMark(&PhysicsMarks::statistics, false);
}

QWidget* PhysicsWidget::createMarks()
{
    auto* group = new QGroupBox(translated("Show while playing"), this);
    auto* grid = new QGridLayout(group);
    for (const MarkRow& row : kMarks) {
        auto* box = new QCheckBox(translated(row.label), group);
        box->setObjectName(QLatin1String(row.name));
        box->setToolTip(translated(row.help));
        connect(box, &QCheckBox::toggled, this, [this, mark = row.mark](bool on) { changeMark(mark, on); });
        const int index = static_cast<int>(boxes_.size());
        grid->addWidget(box, index / 2, index % 2);
        boxes_.emplace_back(box, row.mark);
    }
    return group;
}

QWidget* PhysicsWidget::createRewind()
{
    auto* group = new QGroupBox(translated("Go back"), this);
    auto* grid = new QGridLayout(group);
    slider_ = new QSlider(Qt::Horizontal, group);
    slider_->setObjectName(QStringLiteral("rewind"));
    slider_->setToolTip(translated("Drag to pause and go back; Play goes on from there and forgets what came after"));
    from_ = new QLabel(group);
    now_ = new QLabel(group);
    now_->setObjectName(QStringLiteral("rewind-time"));
    now_->setAlignment(Qt::AlignRight);
    memory_ = new QLabel(group);
    memory_->setEnabled(false);
    grid->addWidget(slider_, 0, 0, 1, 2);
    grid->addWidget(from_, 1, 0);
    grid->addWidget(now_, 1, 1);
    grid->addWidget(memory_, 2, 0, 1, 2);
    connect(slider_, &QSlider::valueChanged, this, [this](int value) {
        editor_.simulation().rewindTo(editor_.simulation().rewindState().oldest + static_cast<std::uint64_t>(value));
    });
    return group;
}

QWidget* PhysicsWidget::createTable()
{
    table_ = new QTableWidget(static_cast<int>(std::size(kNumbers)), 2, this);
    table_->setObjectName(QStringLiteral("numbers"));
    table_->horizontalHeader()->hide();
    table_->verticalHeader()->hide();
    table_->horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
    table_->verticalHeader()->setDefaultSectionSize(20);
    table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    table_->setSelectionMode(QAbstractItemView::NoSelection);
    table_->setShowGrid(false);
    for (int i = 0; i < table_->rowCount(); ++i) {
        table_->setItem(i, 0, new QTableWidgetItem(translated(kNumbers[i].label)));
        auto* number = new QTableWidgetItem;
        number->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
        table_->setItem(i, 1, number);
    }
    return table_;
}

void PhysicsWidget::changeMark(bool PhysicsMarks::*mark, bool on)
{
    PhysicsMarks marks = editor_.simulation().physicsMarks();
    marks.*mark = on;
    editor_.simulation().setPhysicsMarks(marks);
}

void PhysicsWidget::showMarks()
{
    for (const auto& [box, mark] : boxes_) {
        const QSignalBlocker quiet(box);
        box->setChecked(editor_.simulation().physicsMarks().*mark);
    }
}

// The numbers cost a copy of the world in each frame, so they are made only while someone sees them.
void PhysicsWidget::showEvent(QShowEvent* event)
{
    QWidget::showEvent(event);
    changeMark(&PhysicsMarks::statistics, true);
    refresh();
}

void PhysicsWidget::hideEvent(QHideEvent* event)
{
    QWidget::hideEvent(event);
    changeMark(&PhysicsMarks::statistics, false);
}

void PhysicsWidget::refresh()
{
    showRewind();
    showNumbers();
}

void PhysicsWidget::showRewind()
{
    const RewindState state = editor_.simulation().rewindState();
    slider_->setEnabled(state.any && state.newest > state.oldest);
    const auto frame = editor_.simulation().frame();
    if (!state.any || !frame) {
        from_->setText(translated("Nothing is playing."));
        now_->clear();
        memory_->clear();
        return;
    }
    const QSignalBlocker quiet(slider_);
    if (!slider_->isSliderDown()) {
        slider_->setRange(0, static_cast<int>(state.newest - state.oldest));
        slider_->setValue(static_cast<int>(state.present - std::min(state.present, state.oldest)));
    }
    const double step = frame->step > 0 ? frame->time / static_cast<double>(frame->step) : 0;
    from_->setText(translated("from %1 s").arg(QLocale().toString(static_cast<double>(state.oldest) * step, 'f', 2)));
    now_->setText(translated("%1 s, step %2").arg(QLocale().toString(frame->time, 'f', 2)).arg(frame->step));
    memory_->setText(
        translated("%1 MB kept").arg(QLocale().toString(static_cast<double>(state.bytes) / 1048576, 'f', 1)));
}

void PhysicsWidget::showNumbers()
{
    const auto frame = editor_.simulation().frame();
    for (int i = 0; i < table_->rowCount(); ++i)
        table_->item(i, 1)->setText(frame && frame->physics ? kNumbers[i].text(*frame->physics) : QString());
}

}  // namespace jet::panels
