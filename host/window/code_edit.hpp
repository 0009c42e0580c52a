// CodeEdit: a plain text editor for scripts, with line numbers, a marked error line and light colouring of JavaScript.
#pragma once

#include <QPlainTextEdit>

namespace jet::host {

class CodeEdit final : public QPlainTextEdit {
    Q_OBJECT

public:
    explicit CodeEdit(QWidget* parent);

    /// Lines count from 1.
    void goToLine(int line);
    /// 0: none.
    void setErrorLine(int line, const QString& message = {});
    int errorLine() const { return errorLine_; }

signals:
    void focusLeft();

protected:
    bool event(QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;

private:
    class Gutter;

    int gutterWidth() const;
    void placeGutter();
    void paintGutter(QPaintEvent* event);
    void markLines();

    Gutter* gutter_;
    int errorLine_ = 0;
    QString errorText_;
};

}  // namespace jet::host
