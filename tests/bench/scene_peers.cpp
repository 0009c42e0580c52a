#include "bench/scene_peers.hpp"

#include <QApplication>
#include <QGraphicsPathItem>
#include <QGraphicsScene>
#include <QThread>
#include <QUndoStack>
#include <pugixml.hpp>

#include <cstdlib>
#include <vector>

namespace jet::bench {

void parseWithPugixml(const std::string& text)
{
    std::string copy = text;
    pugi::xml_document document;
    const unsigned options = pugi::parse_cdata | pugi::parse_escapes | pugi::parse_eol | pugi::parse_ws_pcdata_single;
    if (!document.load_buffer_inplace(copy.data(), copy.size(), options, pugi::encoding_utf8)) std::abort();
}

struct QtPeer::Private {
    QGraphicsScene scene;
    std::vector<QGraphicsPathItem*> items;
    QUndoStack undo;
};

namespace {

class MoveCommand final : public QUndoCommand {
public:
    MoveCommand(std::vector<QGraphicsPathItem*> items, QPointF by) : items_(std::move(items))
    {
        for (const QGraphicsPathItem* item : items_) old_.push_back(item->pos()), new_.push_back(item->pos() + by);
    }
    void undo() override { place(old_); }
    void redo() override { place(new_); }

private:
    void place(const std::vector<QPointF>& places)
    {
        for (std::size_t i = 0; i < items_.size(); ++i) items_[i]->setPos(places[i]);
    }
    std::vector<QGraphicsPathItem*> items_;
    std::vector<QPointF> old_, new_;
};

}  // namespace

QtPeer& QtPeer::get(int shapes, int columns, double pitch)
{
    static int count = 3;
    static char name[] = "bench", option[] = "-platform", platform[] = "offscreen";
    static char* arguments[] = {name, option, platform, nullptr};
    static QApplication application(count, arguments);
    static auto* one = new QtPeer(shapes, columns, pitch);  // to the end: its items outlive nothing
    return *one;
}

QtPeer::QtPeer(int shapes, int columns, double pitch) : d_(std::make_unique<Private>())
{
    for (int i = 0; i < shapes; ++i) {
        QPainterPath path;
        const QRectF box(i % columns * pitch, i / columns * pitch, 10, 8);
        i % 2 ? path.addEllipse(box) : path.addRect(box);
        d_->items.push_back(d_->scene.addPath(path));
    }
    for (int i = 0; i < 3; ++i) {  // it builds its index by a timer
        d_->scene.items(QPointF(0, 0));
        QThread::msleep(20);
        QCoreApplication::processEvents();
    }
}

void QtPeer::hit(double x, double y) { d_->scene.itemAt(QPointF(x, y), {}); }

void QtPeer::inside(double x, double y, double width, double height)
{
    d_->scene.items(QRectF(x, y, width, height), Qt::ContainsItemBoundingRect, Qt::AscendingOrder);
}

void QtPeer::moveFirst(int count, double dx, double dy)
{
    for (int i = 0; i < count; ++i) d_->items[static_cast<std::size_t>(i)]->moveBy(dx, dy);
    QCoreApplication::processEvents();
}

void QtPeer::pushMove(int count, double dx, double dy)
{
    d_->undo.push(new MoveCommand({d_->items.begin(), d_->items.begin() + count}, {dx, dy}));
}

void QtPeer::undoOrRedo()
{
    d_->undo.canUndo() ? d_->undo.undo() : d_->undo.redo();
    QCoreApplication::processEvents();
}

}  // namespace jet::bench
