/* Stands for libcurl and libcrypto beside Debian's HDF5, which asks them for one thing only: to read files of S3
   through its driver ros3. Cairn never does, and a wheel that carried both would carry thirty libraries more. Whoever asks
   for that driver is told that it cannot begin. */
#include <stddef.h>

int curl_global_init(long flags) {
    (void)flags;
    return 2; /* CURLE_FAILED_INIT */
}
void curl_global_cleanup(void) {}
void* curl_easy_init(void) { return NULL; }
void curl_easy_cleanup(void* handle) { (void)handle; }
int curl_easy_setopt(void* handle, int option, ...) {
    (void)handle;
    (void)option;
    return 2;
}
int curl_easy_perform(void* handle) {
    (void)handle;
    return 2;
}
void* curl_slist_append(void* list, const char* text) {
    (void)text;
    return list;
}
void curl_slist_free_all(void* list) { (void)list; }

const void* EVP_sha256(void) { return NULL; }
unsigned char* HMAC(const void* digest, const void* key, int length, const unsigned char* data, size_t size,
                    unsigned char* result, unsigned* result_size) {
    (void)digest, (void)key, (void)length, (void)data, (void)size, (void)result, (void)result_size;
    return NULL;
}
unsigned char* SHA256(const unsigned char* data, size_t size, unsigned char* result) {
    (void)data, (void)size, (void)result;
    return NULL;
}
