#include "text_lines.hpp"

#include <QTextBoundaryFinder>

#include <algorithm>

namespace jet::writing {

namespace {

qsizetype boundary(const QString& text, qsizetype from, QTextBoundaryFinder::BoundaryType type, bool forward)
{
    QTextBoundaryFinder finder(type, text);
    finder.setPosition(from);
    const qsizetype found = forward ? finder.toNextBoundary() : finder.toPreviousBoundary();
    return found < 0 ? (forward ? text.size() : 0) : found;
}

// Words count from start to start, spaces between them are no place to stop at.
qsizetype wordBoundary(const QString& text, qsizetype from, bool forward)
{
    const auto isSpace = [&](qsizetype at) { return at < text.size() && text[at].isSpace(); };
    do {
        from = boundary(text, from, QTextBoundaryFinder::Word, forward);
    } while (from > 0 && from < text.size() && isSpace(from));
    return from;
}

}  // namespace

qsizetype TextLines::lineStart(int number) const
{
    qsizetype start = 0;
    for (; number > 0; --number) start = text_.indexOf(QLatin1Char('\n'), start) + 1;
    return start;
}

qsizetype TextLines::lineEnd(int number) const
{
    const qsizetype end = text_.indexOf(QLatin1Char('\n'), lineStart(number));
    return end < 0 ? text_.size() : end;
}

std::string TextLines::line(int number) const
{
    const qsizetype start = lineStart(number);
    return text_.mid(start, lineEnd(number) - start).toStdString();
}

int TextLines::caretLine() const { return int(QStringView(text_).left(caret_).count(QLatin1Char('\n'))); }

std::string TextLines::beforeCaret() const
{
    const qsizetype start = lineStart(caretLine());
    return text_.mid(start, caret_ - start).toStdString();
}

void TextLines::setCaret(qsizetype at) { caret_ = std::clamp<qsizetype>(at, 0, text_.size()); }

void TextLines::setCaret(int line, qsizetype column)
{
    line = std::clamp(line, 0, lineCount() - 1);
    caret_ = std::min(lineStart(line) + column, lineEnd(line));
}

void TextLines::setAnchor(qsizetype at) { anchor_ = std::clamp<qsizetype>(at, 0, text_.size()); }

TextLines::Part TextLines::selectedIn(int line) const
{
    const qsizetype from = std::min(caret_, anchor_), to = std::max(caret_, anchor_);
    const qsizetype start = lineStart(line), end = lineEnd(line);
    const qsizetype first = std::clamp(from, start, end), last = std::clamp(to, start, end);
    return {text_.mid(start, first - start).toStdString(), text_.mid(first, last - first).toStdString(),
            from <= end && to > end};
}

std::string TextLines::selected() const
{
    return text_.mid(std::min(caret_, anchor_), std::abs(caret_ - anchor_)).toStdString();
}

void TextLines::selectAll()
{
    anchor_ = 0;
    caret_ = text_.size();
}

void TextLines::selectWord()
{
    QTextBoundaryFinder finder(QTextBoundaryFinder::Word, text_);
    finder.setPosition(caret_);
    const bool isAtStart = finder.isAtBoundary() && caret_ < text_.size() && text_[caret_] != QLatin1Char('\n');
    if (!isAtStart) finder.toPreviousBoundary();
    anchor_ = std::max<qsizetype>(finder.position(), 0);
    finder.setPosition(anchor_);
    const qsizetype end = finder.toNextBoundary();
    caret_ = end < 0 ? text_.size() : end;
}

void TextLines::toSelectionStart()
{
    caret_ = std::min(caret_, anchor_);
    dropSelection();
}

void TextLines::toSelectionEnd()
{
    caret_ = std::max(caret_, anchor_);
    dropSelection();
}

void TextLines::insert(std::string_view utf8)
{
    removeSelection();
    const QString added = QString::fromUtf8(utf8.data(), qsizetype(utf8.size()));
    text_.insert(caret_, added);
    caret_ += added.size();
    dropSelection();
}

bool TextLines::removeSelection()
{
    if (!hasSelection()) return false;
    const qsizetype from = std::min(caret_, anchor_);
    text_.remove(from, std::abs(caret_ - anchor_));
    caret_ = anchor_ = from;
    return true;
}

void TextLines::removeBefore(bool word)
{
    if (!hasSelection()) word ? toPreviousWord() : toPrevious();
    removeSelection();
}

void TextLines::removeAfter(bool word)
{
    if (!hasSelection()) word ? toNextWord() : toNext();
    removeSelection();
}

void TextLines::toPrevious() { caret_ = boundary(text_, caret_, QTextBoundaryFinder::Grapheme, false); }
void TextLines::toNext() { caret_ = boundary(text_, caret_, QTextBoundaryFinder::Grapheme, true); }
void TextLines::toPreviousWord() { caret_ = wordBoundary(text_, caret_, false); }
void TextLines::toNextWord() { caret_ = wordBoundary(text_, caret_, true); }
void TextLines::toLineStart() { caret_ = lineStart(caretLine()); }
void TextLines::toLineEnd() { caret_ = lineEnd(caretLine()); }

void TextLines::toLine(int by)
{
    const int line = caretLine() + by;
    if (line < 0) {
        caret_ = 0;
    } else if (line >= lineCount()) {
        caret_ = text_.size();
    } else {
        setCaret(line, caret_ - lineStart(caretLine()));
    }
}

}  // namespace jet::writing
