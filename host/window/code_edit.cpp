#include "window/code_edit.hpp"

#include "window/script_highlighter.hpp"

#include <QFontDatabase>
#include <QHelpEvent>
#include <QPainter>
#include <QTextBlock>
#include <QToolTip>

namespace jet::host {

namespace {

constexpr int kIndent = 4;
constexpr int kGutterMargin = 10;
const QColor kErrorLine(110, 40, 40), kErrorNumber(255, 120, 110);

QString indentOf(const QString& line)
{
    qsizetype end = 0;
    while (end < line.size() && line[end].isSpace()) ++end;
    return line.left(end);
}

}  // namespace

class CodeEdit::Gutter final : public QWidget {
public:
    explicit Gutter(CodeEdit& edit) : QWidget(&edit), edit_(edit) {}
    QSize sizeHint() const override { return {edit_.gutterWidth(), 0}; }

protected:
    void paintEvent(QPaintEvent* event) override { edit_.paintGutter(event); }

private:
    CodeEdit& edit_;
};

CodeEdit::CodeEdit(QWidget* parent) : QPlainTextEdit(parent), gutter_(new Gutter(*this))
{
    setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
    setLineWrapMode(QPlainTextEdit::NoWrap);
    setTabStopDistance(kIndent * fontMetrics().horizontalAdvance(QLatin1Char(' ')));
    new ScriptHighlighter(document());
    connect(this, &QPlainTextEdit::blockCountChanged, this, &CodeEdit::placeGutter);
    connect(this, &QPlainTextEdit::cursorPositionChanged, this, &CodeEdit::markLines);
    connect(this, &QPlainTextEdit::updateRequest, this, [this](const QRect& area, int dy) {
        dy ? gutter_->scroll(0, dy) : gutter_->update(0, area.y(), gutter_->width(), area.height());
    });
    placeGutter();
    markLines();
}

void CodeEdit::goToLine(int line)
{
    const QTextBlock block = document()->findBlockByNumber(line - 1);
    if (!block.isValid()) return;
    setTextCursor(QTextCursor(block));
    centerCursor();
    setFocus();
}

void CodeEdit::setErrorLine(int line, const QString& message)
{
    errorLine_ = line;
    errorText_ = message;
    markLines();
    gutter_->update();
}

void CodeEdit::markLines()
{
    QList<QTextEdit::ExtraSelection> marks;
    const auto mark = [&](const QTextCursor& cursor, const QColor& color) {
        QTextEdit::ExtraSelection selection;
        selection.cursor = cursor;
        selection.cursor.clearSelection();
        selection.format.setBackground(color);
        selection.format.setProperty(QTextFormat::FullWidthSelection, true);
        marks << selection;
    };
    mark(textCursor(), palette().color(QPalette::Window));
    const QTextBlock wrong = document()->findBlockByNumber(errorLine_ - 1);
    if (errorLine_ > 0 && wrong.isValid()) mark(QTextCursor(wrong), kErrorLine);
    setExtraSelections(marks);
}

// --- line numbers

int CodeEdit::gutterWidth() const
{
    const auto digits = QString::number(std::max(99, blockCount())).size();
    return kGutterMargin + static_cast<int>(digits) * fontMetrics().horizontalAdvance(QLatin1Char('9')) + kGutterMargin;
}

void CodeEdit::placeGutter()
{
    setViewportMargins(gutterWidth(), 0, 0, 0);
    const QRect area = contentsRect();
    gutter_->setGeometry(area.left(), area.top(), gutterWidth(), area.height());
}

void CodeEdit::resizeEvent(QResizeEvent* event)
{
    QPlainTextEdit::resizeEvent(event);
    placeGutter();
}

void CodeEdit::paintGutter(QPaintEvent* event)
{
    QPainter painter(gutter_);
    painter.fillRect(event->rect(), palette().color(QPalette::AlternateBase));
    painter.setFont(font());
    for (QTextBlock block = firstVisibleBlock(); block.isValid(); block = block.next()) {
        const QRectF line = blockBoundingGeometry(block).translated(contentOffset());
        if (line.top() > event->rect().bottom()) break;
        const int number = block.blockNumber() + 1;
        painter.setPen(number == errorLine_ ? kErrorNumber : palette().color(QPalette::PlaceholderText));
        painter.drawText(QRectF(0, line.top(), gutter_->width() - kGutterMargin, line.height()),
                         Qt::AlignRight | Qt::AlignVCenter, QString::number(number));
    }
}

// --- keys

bool CodeEdit::event(QEvent* event)
{
    if (event->type() == QEvent::ShortcutOverride) {
        // With nothing left to undo here, Ctrl+Z goes on to the scene's history.
        auto* key = static_cast<QKeyEvent*>(event);
        const bool undo = key->matches(QKeySequence::Undo) && !document()->isUndoAvailable();
        const bool redo = key->matches(QKeySequence::Redo) && !document()->isRedoAvailable();
        if (undo || redo) {
            event->ignore();
            return true;
        }
    }
    if (event->type() == QEvent::ToolTip && errorLine_ > 0) {
        const auto* help = static_cast<QHelpEvent*>(event);
        const QPoint inViewport = viewport()->mapFromGlobal(help->globalPos());
        const bool onError = cursorForPosition(inViewport).blockNumber() == errorLine_ - 1;
        QToolTip::showText(help->globalPos(), onError ? errorText_ : QString(), this);
        return true;
    }
    return QPlainTextEdit::event(event);
}

void CodeEdit::keyPressEvent(QKeyEvent* event)
{
    if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter) {
        const QString before = textCursor().block().text().left(textCursor().positionInBlock());
        const bool opens = before.trimmed().endsWith(QLatin1Char('{'));
        insertPlainText(QLatin1Char('\n') + indentOf(before) +
                        (opens ? QString(kIndent, QLatin1Char(' ')) : QString()));
        ensureCursorVisible();
    } else if (event->key() == Qt::Key_Tab && !textCursor().hasSelection()) {
        const int column = textCursor().positionInBlock();
        insertPlainText(QString(kIndent - column % kIndent, QLatin1Char(' ')));
    } else {
        QPlainTextEdit::keyPressEvent(event);
    }
}

void CodeEdit::focusOutEvent(QFocusEvent* event)
{
    QPlainTextEdit::focusOutEvent(event);
    emit focusLeft();
}

}  // namespace jet::host
