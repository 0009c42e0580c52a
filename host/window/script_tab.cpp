#include "window/script_tab.hpp"

#include <QVBoxLayout>

namespace jet::host {

namespace {

constexpr int kPauseMs = 700;
constexpr std::string_view kCode = "code";

}  // namespace

ScriptTab::ScriptTab(Scene& scene, ItemId script, Editor& editor, QWidget* parent)
    : QWidget(parent), scene_(scene), script_(script), editor_(editor), code_(new CodeEdit(this))
{
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(code_);
    setFocusProxy(code_);
    known_ = stored();
    code_->setPlainText(QString::fromStdString(known_));
    pause_.setSingleShot(true);
    connect(&pause_, &QTimer::timeout, this, &ScriptTab::commit);
    connect(code_->document(), &QTextDocument::contentsChanged, this, [this] {
        code_->setErrorLine(0);
        pause_.start(kPauseMs);
    });
    connect(code_, &CodeEdit::focusLeft, this, [this] {
        commit();
        ++session_;
    });
    changed_ = editor.events().subscribe<ItemsChanged>(&scene, [this](const ItemsChanged&) { follow(); });
    printed_ = editor.events().subscribe<OutputPrinted>(nullptr, [this](const OutputPrinted& e) { showError(e.line); });
    states_ = editor.events().subscribe<SimulationStateChanged>(nullptr, [this](const SimulationStateChanged& e) {
        if (e.state == SimulationStateChanged::State::Playing) code_->setErrorLine(0);
    });
}

std::string ScriptTab::stored() const
{
    const Item* script = item();
    const std::optional<Value> code = script ? script->property(kCode) : std::nullopt;
    const std::string* text = code ? code->get<std::string>() : nullptr;
    return text ? *text : std::string();
}

QString ScriptTab::title() const
{
    const Item* script = item();
    return script ? QString::fromStdString(script->name()) : QString();
}

void ScriptTab::commit()
{
    pause_.stop();
    const Item* script = item();
    const std::string text = code_->toPlainText().toStdString();
    if (!script || text == known_) return;
    if (scene_.items().inTransaction()) return pause_.start(kPauseMs);  // a drag is going on: later
    known_ = text;
    auto edit = scene_.items().begin("Edit script");
    edit.set(*script, kCode, text);
    edit.commit("script-" + std::to_string(script_.value) + "-" + std::to_string(session_));
}

void ScriptTab::follow()
{
    if (!item()) return emit scriptGone();
    emit titleChanged();
    const std::string now = stored();
    if (now == known_) return;
    known_ = now;
    const int position = code_->textCursor().position();
    code_->setPlainText(QString::fromStdString(now));
    QTextCursor cursor = code_->textCursor();
    cursor.setPosition(std::min(position, code_->document()->characterCount() - 1));
    code_->setTextCursor(cursor);
    pause_.stop();
}

void ScriptTab::showError(const OutputLine& line)
{
    if (line.kind != OutputLine::Kind::Error || line.script != script_ || line.line < 1) return;
    const Scene* played = editor_.simulation().scene();
    if (played && played != &scene_) return;  // the same id in another scene
    code_->setErrorLine(line.line, QString::fromStdString(line.text));
}

}  // namespace jet::host
