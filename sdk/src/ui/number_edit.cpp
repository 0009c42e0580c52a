#include "number_edit.hpp"

#include <jet/ui/number_expression.hpp>

#include <QCoreApplication>
#include <QFontMetrics>
#include <QLineEdit>
#include <QToolTip>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>

namespace jet::ui {

NumberEdit::NumberEdit(const PropertySpec& spec, QWidget* parent)
    : QAbstractSpinBox(parent), whole_(spec.kind == ValueKind::Integer), minimum_(spec.minimum), maximum_(spec.maximum),
      unit_(spec.unit), suffix_(spec.unit.empty() ? QString() : QLatin1Char(' ') + QString::fromStdString(spec.unit))
{
    setFocusPolicy(Qt::StrongFocus);
    setKeyboardTracking(false);
    lineEdit()->setPlaceholderText(QCoreApplication::translate("PropertyEditor", "several values"));
    setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
    connect(this, &QAbstractSpinBox::editingFinished, this, [this] { finish(); });
}

void NumberEdit::setNumber(std::optional<double> number)
{
    number_ = number;
    showProblem({});
    showNumber();
}

/// None: what was typed is fine.
void NumberEdit::showProblem(const QString& message)
{
    if (message.isEmpty() && !wrong_) return;
    if (!wrong_) toolTip_ = toolTip();
    wrong_ = !message.isEmpty();
    QPalette colors = palette();
    if (wrong_) colors.setColor(QPalette::Text, QColor(224, 64, 64));
    lineEdit()->setPalette(wrong_ ? colors : QPalette());
    setToolTip(wrong_ ? message : toolTip_);
    setAccessibleDescription(message);
    if (wrong_ && isVisible()) QToolTip::showText(mapToGlobal(rect().bottomLeft()), message, this);
}

void NumberEdit::showNumber()
{
    const QSignalBlocker quiet(lineEdit());
    lineEdit()->setText(number_ ? textOf(*number_) + suffix_ : QString());
}

QString NumberEdit::textOf(double number) const
{
    // All digits are for who edits; 1/60 s reads better as 0.0166667.
    constexpr int kReadableDigits = 6;
    const bool readable = !hasFocus() && std::abs(number) < 1e6;
    const double shown = readable ? QByteArray::number(number, 'g', kReadableDigits).toDouble() : number;
    return QString::fromStdString(numberText(shown));
}

Result<double> NumberEdit::read(const QString& text) const
{
    auto number = ui::evaluateNumber(text.toStdString(), {unit_, number_});
    return number && whole_ ? Result<double>(std::round(*number)) : number;
}

QValidator::State NumberEdit::validate(QString& input, int&) const
{
    return read(input) ? QValidator::Acceptable : QValidator::Intermediate;
}

double NumberEdit::step() const
{
    // A tenth of the number's magnitude: 0.05 moves by 0.01, 320 by 10.
    if (whole_) return 1;
    const double size = std::abs(number_.value_or(0));
    return size < 1e-9 ? 0.1 : std::pow(10, std::floor(std::log10(size) + 1e-9) - 1);
}

void NumberEdit::stepBy(int steps)
{
    const double unit = step();
    const double moved = number_.value_or(0) + steps * unit;
    accept(std::round(moved / unit) * unit, false);  // onto the raster of the step, so that 0.1 + 0.2 shows as 0.3
}

void NumberEdit::accept(double number, bool done)
{
    const double bounded = std::clamp(number, minimum_, maximum_);
    // Shortest text and back: rounding noise of the step goes no further than the display.
    number_ = done ? bounded : QByteArray::number(bounded, 'g', 12).toDouble();
    spinning_ = !done;
    showNumber();
    if (handler_) handler_(*number_, done);
}

void NumberEdit::finish()
{
    const QString text = lineEdit()->text();
    // A shortened number that nobody touched stays what it is.
    const bool untouched = number_ ? text == textOf(*number_) + suffix_ : text.isEmpty();
    if (untouched) {
        showProblem({});
        if (spinning_ && number_) return accept(*number_, true);
        return showNumber();
    }
    const Result<double> entered = read(text);
    if (!entered) return showProblem(QString::fromStdString(entered.error().message));
    showProblem({});
    if (number_ != *entered || spinning_) return accept(*entered, true);
    showNumber();
}

QAbstractSpinBox::StepEnabled NumberEdit::stepEnabled() const
{
    if (isReadOnly()) return StepNone;
    StepEnabled steps = StepNone;
    if (!number_ || *number_ < maximum_) steps |= StepUpEnabled;
    if (!number_ || *number_ > minimum_) steps |= StepDownEnabled;
    return steps;
}

void NumberEdit::wheelEvent(QWheelEvent* event)
{
    // Scrolling a long Inspector must not change what happens to pass under the pointer.
    if (hasFocus()) {
        QAbstractSpinBox::wheelEvent(event);
    } else {
        event->ignore();
    }
}

void NumberEdit::focusInEvent(QFocusEvent* event)
{
    QAbstractSpinBox::focusInEvent(event);
    showNumber();
    selectAll();
}

QSize NumberEdit::sizeHint() const
{
    const int width = fontMetrics().horizontalAdvance(QStringLiteral("-00000.00 ") + suffix_);
    return {width + 24, QAbstractSpinBox::sizeHint().height()};
}

/// Two side by side fit into a narrow column.
QSize NumberEdit::minimumSizeHint() const
{
    return {fontMetrics().horizontalAdvance(QStringLiteral("0000")) + 24, QAbstractSpinBox::minimumSizeHint().height()};
}

}  // namespace jet::ui
