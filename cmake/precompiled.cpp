// A target needs a source: this one has nothing but the compiled headers (JetPrecompiled.cmake).
