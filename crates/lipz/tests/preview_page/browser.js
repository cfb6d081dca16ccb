// The browser that uses the page: Chromium, or Firefox if BROWSER says so. Both are driven in the same way.

const { Browser } = await import(process.env.BROWSER === "firefox" ? "./firefox.js" : "./chromium.js");
export { Browser };
