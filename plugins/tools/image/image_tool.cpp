// Image tool: a click places a picture in its own size, a drag fits it into the box; Shift fills the box. The file is
// the one in the tool's options, or asked for. It is copied into the project.
#include <jet/plugin.hpp>
#include <jet/tool.hpp>
#include <jet/ui/pictures.hpp>

#include <QApplication>
#include <QFileDialog>
#include <QPointer>

namespace {

class ImageTool final : public jet::Tool {
public:
    using Tool::Tool;
    ~ImageTool() override { delete dialog_; }

    void activate() override
    {
        host().setCursor("cross");
        host().showStatus("Click or drag where the picture goes. Shift: it fills the box.");
    }
    void deactivate() override
    {
        cancel();
        delete dialog_;
    }

    void press(const jet::PointerEvent& event) override
    {
        if (event.button != jet::PointerButton::Left) return;
        dragging_ = true;
        start_ = end_ = event.scene;
    }

    void drag(const jet::PointerEvent& event) override
    {
        end_ = event.scene;
        host().requestRepaint();
    }

    void release(const jet::PointerEvent& event) override
    {
        if (!dragging_) return;
        end_ = event.scene;
        cancel();
        const bool isClick = (end_ - start_).norm() * host().pixelsPerUnit() < kClickPixels;
        frame_ = isClick ? jet::Box(start_, start_) : jet::Box(start_, end_);
        fit_ = event.modifiers.shift ? jet::ui::PictureFit::Stretch : jet::ui::PictureFit::Inside;
        const auto file = host().options().get("file", options()).as<std::string>();
        file.empty() ? ask() : place(file);
    }

    bool cancel() override
    {
        if (!dragging_) return false;
        dragging_ = false;
        host().requestRepaint();
        return true;
    }

    void paint(jet::Painter& painter) const override
    {
        if (!dragging_) return;
        const jet::Path box = jet::Path::rectangle(jet::Box(start_, end_));
        painter.stroke(box, host().layerPen());
    }

    const jet::PropertyTable& options() const override
    {
        static const jet::PropertyTable table{
            jet::text("file", "File", "").says("The picture to place; empty: it is asked for each time.")};
        return table;
    }

private:
    static constexpr double kClickPixels = 4;

    // Not modal by a loop of its own: nothing waits inside of a call from the host.
    void ask()
    {
        delete dialog_;
        if (!qobject_cast<QApplication*>(QCoreApplication::instance()))
            return host().showStatus("Without a window nobody can be asked: set the tool's option \"file\".");
        dialog_ =
            new QFileDialog(QApplication::activeWindow(), QApplication::translate("ImageTool", "Place a picture"));
        dialog_->setObjectName("image-tool-file");
        dialog_->setAttribute(Qt::WA_DeleteOnClose);
        dialog_->setOption(QFileDialog::DontUseNativeDialog);
        dialog_->setFileMode(QFileDialog::ExistingFile);
        dialog_->setNameFilter(QString::fromStdString(jet::ui::pictureFilter()));
        QObject::connect(dialog_, &QFileDialog::fileSelected, dialog_,
                         [this](const QString& file) { place(file.toStdString()); });
        dialog_->open();
    }

    void place(const std::string& file)
    {
        if (host().items().inTransaction()) return;
        auto edit = host().items().begin("Place picture");
        try {
            edit.select(jet::ui::addPicture(edit, host().insertionPoint(edit), host().scene(), file, frame_, fit_));
            edit.commit();
        } catch (const jet::Failure& failure) {
            edit.rollback();
            host().showStatus(failure.error().text());
        }
    }

    bool dragging_ = false;
    jet::Vec2 start_, end_;  // scene units
    jet::Box frame_;         // of the picture to come; a point: its own size
    jet::ui::PictureFit fit_ = jet::ui::PictureFit::Inside;
    QPointer<QFileDialog> dialog_;
};

}  // namespace

JET_PLUGIN(plugin) { plugin.tool<ImageTool>("image-tool"); }
