// The depth map of the mesh obstacles has depths only.
void main() {}
