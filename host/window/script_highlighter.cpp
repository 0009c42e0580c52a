#include "window/script_highlighter.hpp"

#include <QColor>
#include <QRegularExpression>

namespace jet::host {

namespace {

const QColor kKeyword(199, 146, 234), kNumber(247, 140, 108), kString(195, 232, 141), kComment(110, 118, 130);

// One pass, first match wins: a keyword inside a string is part of the string. The last alternative is a comment left
// open.
const QRegularExpression& tokens()
{
    static const QRegularExpression expression(QStringLiteral(
        R"((?<comment>//.*|/\*.*?\*/)|(?<string>"(?:[^"\\]|\\.)*"?|'(?:[^'\\]|\\.)*'?)|(?<open>/\*.*$))"
        R"(|(?<number>\b(?:0x[0-9a-fA-F]+|\d+\.?\d*(?:[eE][+-]?\d+)?)\b|\.\d+))"
        R"(|(?<keyword>\b(?:break|case|catch|continue|default|delete|do|else|false|finally|for|function|if|in|instanceof|new|null)"
        R"(|return|switch|this|throw|true|try|typeof|undefined|var|void|while|with)\b))"));
    return expression;
}

enum BlockState { Code = 0, InComment = 1 };

}  // namespace

void ScriptHighlighter::highlightBlock(const QString& text)
{
    qsizetype start = 0;
    setCurrentBlockState(Code);
    if (previousBlockState() == InComment) {
        const qsizetype end = text.indexOf(QLatin1String("*/"));
        start = end < 0 ? text.size() : end + 2;
        setFormat(0, static_cast<int>(start), kComment);
        if (end < 0) return setCurrentBlockState(InComment);
    }
    struct Kind {
        const char* name;
        QColor color;
    };
    for (auto match = tokens().globalMatch(text, start); match.hasNext();) {
        const QRegularExpressionMatch token = match.next();
        for (const Kind& kind : {Kind{"comment", kComment}, Kind{"string", kString}, Kind{"number", kNumber},
                                 Kind{"keyword", kKeyword}, Kind{"open", kComment}}) {
            const QString name = QLatin1String(kind.name);
            if (token.capturedStart(name) < 0) continue;
            setFormat(static_cast<int>(token.capturedStart(name)), static_cast<int>(token.capturedLength(name)),
                      kind.color);
            if (name == QLatin1String("open")) setCurrentBlockState(InComment);
        }
    }
}

}  // namespace jet::host
