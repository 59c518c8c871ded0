// Nothing: this file is here so that its precompiled header is made.
