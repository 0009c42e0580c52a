// TextLines: the text being edited, with a caret that stands between what a reader takes for letters.
#pragma once

#include <QString>

#include <string>
#include <string_view>

namespace jet::writing {

class TextLines {
public:
    TextLines() = default;
    explicit TextLines(std::string_view utf8) : text_(QString::fromUtf8(utf8.data(), qsizetype(utf8.size()))) {}

    std::string utf8() const { return text_.toStdString(); }
    bool isBlank() const { return text_.trimmed().isEmpty(); }
    int lineCount() const { return int(text_.count(QLatin1Char('\n'))) + 1; }
    std::string line(int number) const;

    /// Where the caret is: the line, and what is before it there.
    int caretLine() const;
    std::string beforeCaret() const;
    /// How many letters are before it in all the text: what setCaret() takes.
    qsizetype caret() const { return caret_; }
    void setCaret(qsizetype at);
    /// Into a line, after `column` UTF-16 units of it at most.
    void setCaret(int line, qsizetype column);

    void insert(std::string_view utf8);
    void removeBefore();
    void removeAfter();
    void toPrevious();
    void toNext();
    void toPreviousWord();
    void toNextWord();
    void toLineStart();
    void toLineEnd();
    /// The same column `by` lines further; at the first and last line to its start or end.
    void toLine(int by);

private:
    qsizetype lineStart(int number) const;
    qsizetype lineEnd(int number) const;

    QString text_;
    qsizetype caret_ = 0;
};

}  // namespace jet::writing
