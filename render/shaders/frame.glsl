// What the shader of plain tiles knows of the frame; mirrors FrameBlock in picture_pass.h. All positions are relative to the eye,
// which keeps single precision where the picture is.
struct Frame {
    vec4 right;             // half the picture's width, on the plane at view depth 1 (parallel projection: on any plane)
    vec4 up;                // half its height, likewise
    vec4 forward;           // unit
    vec4 picture;           // one over the width and the height
    vec4 ground;            // its colour, not faded yet; w: its height
    vec4 groundCenter;      // w: one over the fade distance
    vec4 backgroundTop;
    vec4 backgroundBottom;
};

// The vertex shader hands the frame over: a software renderer gathers a uniform lane by lane for each few pixels, but keeps a flat
// input ready for all of them.
#ifdef VERTEX
layout(std140) uniform FrameBlock { Frame block; };
flat out Frame frame;
#else
flat in Frame frame;
#endif
