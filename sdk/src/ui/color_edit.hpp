// ColorEdit: a swatch that opens a palette, and the colour as text beside it.
#pragma once

#include <jet/value.hpp>

#include <QLineEdit>
#include <QToolButton>
#include <QWidget>

#include <functional>
#include <optional>

namespace jet::ui {

class ColorEdit final : public QWidget {
public:
    explicit ColorEdit(QWidget* parent);

    /// None: blank.
    void setColor(std::optional<Color> color);
    /// `done` is false while the user tries colours in the dialog.
    void setHandler(std::function<void(Color color, bool done)> handler) { handler_ = std::move(handler); }

private:
    void accept(Color color, bool done);
    void fillPalette();
    void openDialog();
    void readText();

    QToolButton* swatch_;
    QLineEdit* text_;
    std::optional<Color> color_;
    std::function<void(Color, bool)> handler_;
};

}  // namespace jet::ui
