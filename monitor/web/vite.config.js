// Builds the page into the folder that CMake names; everything it loads is its own file, so that the content security policy can stay strict.
import {defineConfig} from 'vite';

export default defineConfig({
  base: './',
  build: {
    outDir: process.env.INTERLACE_PAGE_DIR || 'dist',
    emptyOutDir: true,
    assetsInlineLimit: 0,
    modulePreload: {polyfill: false},
    chunkSizeWarningLimit: 1200,
    target: 'es2020',
  },
});
