/* A library of Windows that Rust's standard library needs, and that Wine has only since version 8.5. */
__declspec(dllimport) unsigned char __stdcall SystemFunction036(void *data, unsigned long length_bytes);

__declspec(dllexport) int __stdcall ProcessPrng(unsigned char *data, unsigned long long length_bytes) {
    return SystemFunction036(data, (unsigned long)length_bytes);
}
