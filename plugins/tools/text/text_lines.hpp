// TextLines: the text being edited, with a caret that stands between what a reader takes for letters, and a selection
// from its other end, the anchor, to the caret. Moving the caret leaves the anchor where it is: dropSelection() brings
// it along.
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
    /// What is selected of a line: how much of it is before the selection and in it. Nothing selected: both empty.
    struct Part {
        std::string before, selected;
        bool isToTheEnd = false;  ///< and goes on in the next line
    };
    Part selectedIn(int line) const;

    bool hasSelection() const { return caret_ != anchor_; }
    std::string selected() const;
    void dropSelection() { anchor_ = caret_; }
    void selectAll();
    /// The word, or the spaces between two, around the caret.
    void selectWord();
    /// Caret to the selection's start or end, without it.
    void toSelectionStart();
    void toSelectionEnd();
    /// How many letters are before it in all the text: what setCaret() takes.
    qsizetype caret() const { return caret_; }
    void setCaret(qsizetype at);
    qsizetype anchor() const { return anchor_; }
    void setAnchor(qsizetype at);
    /// Into a line, after `column` UTF-16 units of it at most.
    void setCaret(int line, qsizetype column);

    /// In place of the selection.
    void insert(std::string_view utf8);
    /// The selection, else the letter, or all of the word, before or after the caret.
    void removeBefore(bool word = false);
    void removeAfter(bool word = false);
    bool removeSelection();
    void toPrevious();
    void toNext();
    void toPreviousWord();
    void toNextWord();
    void toLineStart();
    void toLineEnd();
    void toStart() { caret_ = 0; }
    void toEnd() { caret_ = text_.size(); }
    /// The same column `by` lines further; at the first and last line to its start or end.
    void toLine(int by);

private:
    qsizetype lineStart(int number) const;
    qsizetype lineEnd(int number) const;

    QString text_;
    qsizetype caret_ = 0, anchor_ = 0;
};

}  // namespace jet::writing
