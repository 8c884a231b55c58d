// A page on a fake server, one of each for all tests of a file.

import { after, before } from 'node:test';
import { openBrowser } from './browser.mjs';
import { FakeServer } from './fake_server.mjs';

export const server = new FakeServer();
/** @type {Awaited<ReturnType<typeof openBrowser>>} */
export let browser;
/** @type {import('playwright-core').Page} */
export let page;

/**
 * Starts both before the first test, and stops them after the last.
 * @param {import('./browser.mjs').BrowserContextOptions} [options]
 */
export function useFakePage(options = {}) {
  before(async () => {
    await server.start();
    browser = await openBrowser(options);
    page = browser.page;
  });
  after(async () => {
    await browser?.close();
    await server.stop();
  });
}
