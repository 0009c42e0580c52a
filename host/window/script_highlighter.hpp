// ScriptHighlighter: keywords, numbers, strings and comments of JavaScript in colour.
#pragma once

#include <QSyntaxHighlighter>

namespace jet::host {

class ScriptHighlighter final : public QSyntaxHighlighter {
    Q_OBJECT

public:
    explicit ScriptHighlighter(QTextDocument* document) : QSyntaxHighlighter(document) {}

protected:
    void highlightBlock(const QString& text) override;
};

}  // namespace jet::host
