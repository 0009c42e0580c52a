// Output panel: the script console (thesis §3.4.5). Lines arrive in batches, so that a script printing at every step
// does not stop the window; the last 10,000 are kept.
#include <jet/editor.hpp>
#include <jet/plugin.hpp>
#include <jet/ui/icons.hpp>
#include <jet/ui/panel.hpp>

#include <QCoreApplication>
#include <QFontDatabase>
#include <QHBoxLayout>
#include <QMouseEvent>
#include <QPlainTextEdit>
#include <QScrollBar>
#include <QTextBlock>
#include <QTimer>
#include <QToolButton>

#include <deque>

namespace {

using jet::OutputLine;

constexpr int kMostLines = 10000;
constexpr int kBatchMs = 40;

QString translated(const char* text) { return QCoreApplication::translate("OutputPanel", text); }

/// Where a line comes from, kept with its block.
struct Origin final : public QTextBlockUserData {
    Origin(jet::ItemId id, int number) : script(id), line(number) {}
    jet::ItemId script;
    int line;
};

QColor colorOf(OutputLine::Kind kind, const QPalette& palette)
{
    switch (kind) {
    case OutputLine::Kind::Warning: return {242, 178, 76};
    case OutputLine::Kind::Error: return {255, 120, 110};
    default: return palette.color(QPalette::Text);
    }
}

class OutputWidget final : public QWidget {
public:
    explicit OutputWidget(jet::Editor& editor) : editor_(editor), text_(new QPlainTextEdit(this))
    {
        text_->setReadOnly(true);
        text_->setUndoRedoEnabled(false);
        text_->setMaximumBlockCount(kMostLines);
        text_->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
        text_->setPlaceholderText(translated("What scripts print appears here."));
        text_->viewport()->installEventFilter(this);
        auto* layout = new QHBoxLayout(this);
        layout->setContentsMargins(0, 0, 0, 0);
        layout->setSpacing(0);
        layout->addWidget(text_);
        layout->addWidget(createClearButton(), 0, Qt::AlignTop);
        batch_.setSingleShot(true);
        connect(&batch_, &QTimer::timeout, this, [this] { append(); });
        printed_ = editor.events().subscribe<jet::OutputPrinted>(nullptr,
                                                                 [this](const jet::OutputPrinted& e) { take(e.line); });
    }

protected:
    bool eventFilter(QObject*, QEvent* event) override
    {
        if (event->type() != QEvent::MouseButtonRelease && event->type() != QEvent::MouseButtonDblClick) return false;
        const auto* mouse = static_cast<QMouseEvent*>(event);
        if (mouse->button() == Qt::LeftButton && !text_->textCursor().hasSelection()) openOrigin(mouse->pos());
        return false;
    }

private:
    QToolButton* createClearButton()
    {
        auto* clear = new QToolButton(this);
        clear->setIcon(jet::ui::icon("clear"));
        clear->setToolTip(translated("Clear"));
        clear->setAutoRaise(true);
        connect(clear, &QToolButton::clicked, this, [this] {
            waiting_.clear();
            text_->clear();
        });
        return clear;
    }

    void take(const OutputLine& line)
    {
        waiting_.push_back(line);
        if (waiting_.size() > kMostLines) waiting_.pop_front();
        if (!batch_.isActive()) batch_.start(kBatchMs);
    }

    void append()
    {
        QScrollBar& bar = *text_->verticalScrollBar();
        const bool atEnd = bar.value() >= bar.maximum() - 2;  // who scrolled up wants to read, not to be pulled down
        QTextCursor cursor(text_->document());
        cursor.beginEditBlock();
        for (const OutputLine& line : waiting_) appendLine(cursor, line);
        cursor.endEditBlock();
        waiting_.clear();
        if (atEnd) bar.setValue(bar.maximum());
    }

    void appendLine(QTextCursor& cursor, const OutputLine& line)
    {
        cursor.movePosition(QTextCursor::End);
        if (!text_->document()->isEmpty()) cursor.insertBlock();
        QTextCharFormat format;
        format.setForeground(colorOf(line.kind, palette()));
        const bool opens = line.script && line.line > 0;
        format.setFontUnderline(opens);
        QString shown = QString::fromStdString(line.text);
        shown.replace(QLatin1Char('\n'), QChar::LineSeparator);  // one message, one block
        cursor.insertText(shown, format);
        if (opens) cursor.block().setUserData(new Origin(line.script, line.line));  // the block takes it
    }

    void openOrigin(const QPoint& at)
    {
        const auto* origin = static_cast<Origin*>(text_->cursorForPosition(at).block().userData());
        jet::Scene* scene = editor_.activeScene();
        if (origin && scene) editor_.openScript(*scene, origin->script, origin->line);
    }

    jet::Editor& editor_;
    QPlainTextEdit* text_;
    QTimer batch_;
    std::deque<OutputLine> waiting_;
    jet::Subscription printed_;
};

class OutputPanel final : public jet::Panel {
public:
    using Panel::Panel;
    QWidget* createWidget() override { return new OutputWidget(editor()); }
};

}  // namespace

JET_PLUGIN(plugin) { plugin.panel<OutputPanel>("output"); }
