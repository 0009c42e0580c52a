// The engines of the comparison behind one interface. Each keeps the scene's bodies in the scene's order.
#pragma once

#include "bench/physics/scene.hpp"

#include <memory>
#include <span>

namespace jet::bench {

struct Pose {
    Point position;  // of the body's origin
    double angle = 0;
};

class Engine {
public:
    virtual ~Engine() = default;
    virtual void step(double dt) = 0;
    virtual Pose pose(std::size_t body) const = 0;
    /// Bytes the engine holds; 0: not known.
    virtual std::size_t memory() const { return 0; }
    virtual std::uint64_t hash() const { return 0; }
    virtual std::vector<std::byte> save() const { return {}; }
    virtual void restore(std::span<const std::byte>) {}
};

struct JetOptions {
    int threads = 1;
    std::string simd;       // "", "sse2", "avx2" or "avx512"
    std::string precision;  // "", "double" or "single"
    int substeps = 0;
};

std::unique_ptr<Engine> makeJet(const Scene&, const JetOptions&);
/// Instructions JET has kernels for and this processor, too, the widest first.
std::vector<std::string> jetSimds();
/// Those of them that run other code than the next in this scene.
std::vector<std::string> jetSimds(const Scene&);
std::unique_ptr<Engine> makeBox2d(const Scene&);
std::unique_ptr<Engine> makeChipmunk(const Scene&);
/// For scenes of soft bodies between fixed boxes.
std::unique_ptr<Engine> makeBullet(const Scene&);

}  // namespace jet::bench
