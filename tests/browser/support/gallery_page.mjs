// A page on the real server with a painted gallery, one of each for all tests of a file. Needs
// HAARMONY_BIN, the folder of the executables.

import { after, before } from 'node:test';
import { openBrowser } from './browser.mjs';
import { GalleryServer } from './daemon.mjs';

const bin = process.env.HAARMONY_BIN;

/** What a test is given as its option, so that it says why it does not run. */
export const skip = bin ? false : 'HAARMONY_BIN is not set: no executables to test with';
/** @type {GalleryServer} */
export let server;
/** @type {Awaited<ReturnType<typeof openBrowser>> | null} */
export let browser = null;
/** @type {import('playwright-core').Page} */
export let page;
/** The gallery in its order. @type {{id: number, uri: string}[]} */
export let pictures;

/**
 * Paints, ingests and serves before the first test, and tidies up after the last.
 * @param {number} count
 * @param {number} [copies] so many of the first pictures are there twice
 */
export function useGalleryPage(count, copies = 0) {
  before(async () => {
    if (!bin) return;
    server = new GalleryServer(bin);
    try {
      await server.fill(count, copies);
      await server.start();
      pictures = (await (await fetch(`${server.address}images?limit=1000`)).json()).items;
      browser = await openBrowser();
      page = browser.page;
    } catch (error) {
      await tidy(); // the runner skips after() when before() fails, and would wait for the daemon
      throw error;
    }
  });
  after(async () => {
    if (bin) await tidy();
  });
}

async function tidy() {
  await browser?.close();
  await server.stop();
  server.remove();
}
