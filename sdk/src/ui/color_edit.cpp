#include "color_edit.hpp"

#include <QColorDialog>
#include <QCoreApplication>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QMenu>
#include <QPainter>
#include <QWidgetAction>

namespace jet::ui {

namespace {

// Five hues' worth of ready colours, light to dark, and greys: most games are coloured from them without a dialog.
constexpr const char* kPalette[] = {
    "#ffffff", "#d9d9d9", "#a6a6a6", "#737373", "#404040", "#000000",  //
    "#ff9b8f", "#e8503f", "#c0281a", "#ffb765", "#f28c1e", "#b85f00",  //
    "#fff08a", "#f5d327", "#c29f00", "#b4e08a", "#4caf50", "#2e7d32",  //
    "#8fdcd6", "#26a69a", "#00695c", "#9bcbff", "#3d8bfd", "#1a4fa3",  //
    "#c9b3ff", "#8b5cf6", "#5b21b6", "#ffb0d9", "#e0529c", "#8d6e63",  //
};
constexpr int kPaletteColumns = 6;

QColor toQColor(Color color) { return {color.r, color.g, color.b, color.a}; }

Color fromQColor(const QColor& color)
{
    const auto byte = [](int value) { return static_cast<std::uint8_t>(value); };
    return {byte(color.red()), byte(color.green()), byte(color.blue()), byte(color.alpha())};
}

QIcon swatchIcon(std::optional<Color> color, const QPalette& palette)
{
    QPixmap pixmap(32, 32);
    pixmap.fill(Qt::transparent);
    QPainter painter(&pixmap);
    painter.setRenderHint(QPainter::Antialiasing);
    const QRectF box(2, 2, 28, 28);
    if (!color || color->a < 255) painter.fillRect(box, QBrush(palette.color(QPalette::Mid), Qt::Dense4Pattern));
    painter.setPen(QPen(palette.color(QPalette::Mid), 2));
    painter.setBrush(color ? QBrush(toQColor(*color)) : QBrush(Qt::NoBrush));
    painter.drawRoundedRect(box, 4, 4);
    return QIcon(pixmap);
}

}  // namespace

ColorEdit::ColorEdit(QWidget* parent) : QWidget(parent), swatch_(new QToolButton(this)), text_(new QLineEdit(this))
{
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(4);
    layout->addWidget(swatch_);
    layout->addWidget(text_, 1);
    swatch_->setPopupMode(QToolButton::InstantPopup);
    swatch_->setAutoRaise(true);
    setFocusProxy(text_);
    fillPalette();
    connect(text_, &QLineEdit::editingFinished, this, [this] { readText(); });
    setColor(std::nullopt);
}

void ColorEdit::setColor(std::optional<Color> color)
{
    color_ = color;
    swatch_->setIcon(swatchIcon(color, palette()));
    text_->setText(color ? QString::fromStdString(color->text()) : QString());
}

void ColorEdit::accept(Color color, bool done)
{
    setColor(color);
    if (handler_) handler_(color, done);
}

void ColorEdit::readText()
{
    const Result<Color> color = Color::parse(text_->text().trimmed().toStdString());
    if (!color) return setColor(color_);  // not a colour: back to what it was
    if (color_ != *color) accept(*color, true);
}

void ColorEdit::fillPalette()
{
    auto* menu = new QMenu(swatch_);
    auto* grid = new QWidget(menu);
    auto* layout = new QGridLayout(grid);
    layout->setSpacing(2);
    int place = 0;
    for (const char* text : kPalette) {
        const Color color = Color::parse(text).orThrow();
        auto* button = new QToolButton(grid);
        button->setAutoRaise(true);
        button->setIcon(swatchIcon(color, palette()));
        button->setToolTip(QLatin1String(text));
        connect(button, &QToolButton::clicked, this, [this, menu, color] {
            menu->close();
            accept(color, true);
        });
        layout->addWidget(button, place / kPaletteColumns, place % kPaletteColumns);
        ++place;
    }
    auto* colors = new QWidgetAction(menu);
    colors->setDefaultWidget(grid);
    menu->addAction(colors);
    menu->addAction(QCoreApplication::translate("ColorEdit", "Other colour…"), this, [this] { openDialog(); });
    swatch_->setMenu(menu);
}

void ColorEdit::openDialog()
{
    const std::optional<Color> before = color_;
    auto* dialog = new QColorDialog(before ? toQColor(*before) : QColor(Qt::white), window());
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setOptions(QColorDialog::ShowAlphaChannel | QColorDialog::DontUseNativeDialog);
    connect(dialog, &QColorDialog::currentColorChanged, this,
            [this](const QColor& c) { accept(fromQColor(c), false); });
    connect(dialog, &QColorDialog::colorSelected, this, [this](const QColor& c) { accept(fromQColor(c), true); });
    connect(dialog, &QDialog::rejected, this, [this, before] {
        if (before) accept(*before, true);
    });
    dialog->open();
}

}  // namespace jet::ui
