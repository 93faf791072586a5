/// The small passes over the screen.
#pragma once

#include "passes/pass.hpp"

namespace lobe {

/// Coverage 1 where there is a surface, when no other pass writes it.
class CoveragePass : public Pass {
public:
    using Pass::Pass;
    void prepare() override;
    void run(const View& view) override;

private:
    const gl::Program* program_ = nullptr;
};

/// The environment where no surface is.
class BackgroundPass : public Pass {
public:
    using Pass::Pass;
    void prepare() override;
    void run(const View& view) override;

private:
    const gl::Program* program_ = nullptr;
    const gl::Program* coverage_ = nullptr;  ///< where it is not in the same picture
};

/// Dims each contribution by what the blended surfaces in front of it let through.
class DimPass : public Pass {
public:
    using Pass::Pass;
    void prepare() override;
    void run(const View& view) override;

private:
    const gl::Program* program_ = nullptr;
};

/// Adds each picture of the frame to its mean over all samples. run() takes the frame that was drawn last.
class AccumulatePass : public Pass {
public:
    using Pass::Pass;
    void prepare() override;
    void run(const View& view) override;

private:
    const gl::Program* program_ = nullptr;
};

/// Data AOVs from the G-buffer, one program a model.
class AovPass : public Pass {
public:
    using Pass::Pass;
    void prepare() override;
    void run(const View& view) override;

private:
    const gl::Program& program(const Variant& variant) const;
};

}  // namespace lobe
